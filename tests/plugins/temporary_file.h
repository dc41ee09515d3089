// A file that is gone when its test is done, or thrown out of.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace scantet::test {

/// A file in the folder for temporary files, removed by the destructor.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name)
      : path_(
            (std::filesystem::temp_directory_path() / ("scantet_" + std::to_string(getpid()) + "_" + name)).string()) {}
  /// One that holds these bytes.
  TemporaryFile(const std::string& name, const std::string& bytes) : TemporaryFile(name) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace scantet::test
