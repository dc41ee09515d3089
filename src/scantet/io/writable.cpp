// The surest check that a file can be written is to begin one: AtomicFile makes its temporary file and takes it away.
#include "scantet/io/writable.h"

#include <system_error>

#include "scantet/base/error.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/atomic_folder_impl.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/resolved_path.h"

namespace scantet {
namespace {

bool is_in_folder(const std::string& file, const std::string& folder) {
  std::error_code failure;
  const std::string target = resolved_path(folder, failure).string() + "/";
  return !failure && resolved_path(file, failure).string().starts_with(target);
}

}  // namespace

void check_writable(const std::vector<std::string>& files, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    const FolderContent content = folder_content(files[i]);
    for (const std::string& input : inputs) {
      if (!is_same_file(files[i], input) && (content == nullptr || !is_in_folder(input, files[i]))) continue;
      throw Error(Fault::usage, "usage.same_file", files[i] + ": this output is also read, as " + input,
                  "choose another name");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_same_file(files[i], files[j])) continue;
      throw Error(Fault::usage, "usage.same_file", files[i] + ": named twice as an output", "name it once");
    }
    if (content != nullptr) {
      for (const std::string& other : files) {
        if (!is_in_folder(other, files[i])) continue;
        throw Error(Fault::usage, "usage.same_file",
                    other + ": this output is in the folder " + files[i] + ", which is another output",
                    "choose another name");
      }
      const AtomicFolder probe(files[i], content, nullptr);
    } else {
      const AtomicFile probe(files[i]);
    }
  }
}

}  // namespace scantet
