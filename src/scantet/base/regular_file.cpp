// Links are followed: /dev/stdin counts as a file if a file is behind it.
#include "scantet/base/regular_file.h"

#include <filesystem>

#include "scantet/base/error.h"

namespace scantet {

void check_regular_file(const std::string& path) {
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  if (failure || std::filesystem::is_regular_file(status) || std::filesystem::is_directory(status)) return;
  const bool pipe = std::filesystem::is_fifo(status);
  throw Error(Fault::input, "input.not_a_file",
              "'" + path + "' is " + (pipe ? "a pipe" : "a device or a socket") + ", neither a file nor a folder",
              "write what comes from it to a file first");
}

}  // namespace scantet
