// The surest check that a file can be written is to begin one: AtomicFile makes its temporary file and takes it away.
#include "scantet/io/writable.h"

#include "scantet/base/error.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/resolved_path.h"

namespace scantet {

void check_writable(const std::vector<std::string>& files, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (const std::string& input : inputs) {
      if (!is_same_file(files[i], input)) continue;
      throw Error(Fault::usage, "usage.same_file", files[i] + ": this output is also read, as " + input,
                  "choose another name");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_same_file(files[i], files[j])) continue;
      throw Error(Fault::usage, "usage.same_file", files[i] + ": named twice as an output", "name it once");
    }
    const AtomicFile probe(files[i]);
  }
}

}  // namespace scantet
