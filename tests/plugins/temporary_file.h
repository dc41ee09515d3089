// A file that is gone when its test is done, or thrown out of.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace scantet::test {

/// A file in the folder for temporary files, removed by the destructor.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name)
      : path_(
            (std::filesystem::temp_directory_path() / ("scantet_" + std::to_string(getpid()) + "_" + name)).string()) {}
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace scantet::test
