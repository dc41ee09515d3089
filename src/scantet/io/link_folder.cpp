// A folder in the making that is never finished: it has their lock, and is swept as they are.
#include "scantet/io/link_folder.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string_view>

#include "scantet/base/error.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/atomic_folder_impl.h"

namespace scantet {

namespace fs = std::filesystem;

namespace {

/// A name of this user's; nothing ever has it, only the unfinished folder's name is made of it.
std::string target() {
  std::error_code failure;
  const fs::path folder = fs::temp_directory_path(failure);
  if (!failure) return (folder / ("scantet-links-" + std::to_string(getuid()))).string();
  throw Error(Fault::output, "output.cannot_write", "TMPDIR names no folder",
              "set TMPDIR to a folder that can be written");
}

bool is_nothing_of_ours(std::string_view) {
  return false;
}

}  // namespace

LinkFolder::LinkFolder() : folder_(std::make_unique<AtomicFolder>(target(), is_nothing_of_ours, nullptr)) {}

LinkFolder::~LinkFolder() = default;

std::string LinkFolder::add(const std::string& path, const std::string& part_path) const {
  const fs::path link = fs::path(folder_->part_path()) / fs::path(path).filename();
  std::error_code failure;
  fs::create_symlink(part_path, link, failure);
  if (failure) throw_output_error(link.string(), failure.value());
  return link.string();
}

}  // namespace scantet
