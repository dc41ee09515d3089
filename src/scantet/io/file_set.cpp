// All that can take long or fail is done before the first file is renamed.
#include "scantet/io/file_set.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/sha256.h"
#include "scantet/io/unfinished_file_impl.h"

namespace scantet {
namespace {

void add_files_in(const UnfinishedFile& folder, std::vector<FileSet::Part>& parts) {
  const std::size_t first = parts.size();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.part_path())) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().lexically_relative(folder.part_path()).string();
    parts.push_back({folder.path() + "/" + name, entry.path().string()});
  }
  std::sort(parts.begin() + static_cast<std::ptrdiff_t>(first), parts.end(),
            [](const auto& a, const auto& b) { return a.path < b.path; });
}

}  // namespace

FileSet::FileSet() = default;
FileSet::~FileSet() = default;

void FileSet::add(std::unique_ptr<UnfinishedFile> file) {
  files_.push_back(std::move(file));
}

std::vector<FileSet::Part> FileSet::parts() const {
  std::vector<Part> parts;
  for (const auto& file : files_) parts.push_back({file->path(), file->part_path()});
  return parts;
}

std::vector<FileSet::Entry> FileSet::entries() const {
  std::vector<Part> all;
  for (const auto& file : files_) {
    if (file->is_folder()) {
      add_files_in(*file, all);
    } else {
      all.push_back({file->path(), file->part_path()});
    }
  }
  std::vector<Entry> entries(all.size());
  parallel_for(all.size(), 1, [&](std::size_t i, std::size_t) {
    entries[i] = {all[i].path, sha256_file(all[i].part_path)};
  });
  return entries;
}

void FileSet::commit() {
  std::string done;
  for (const auto& file : files_) {
    const int failure = file->appear();
    if (failure != 0 && done.empty()) throw_output_error(file->path(), failure);
    if (failure != 0) {
      throw Error(Fault::output, "output.partial",
                  "cannot write '" + file->path() + "': " + std::generic_category().message(failure) +
                      "; of this run there is only " + done,
                  "run it again, or remove these");
    }
    done += (done.empty() ? "'" : ", '") + file->path() + "'";
  }
  for (const auto& file : files_) file->sync_folder();
  files_.clear();
}

}  // namespace scantet
