// Runs the real executable and keeps what it says.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scantet {

struct RunOptions {
  std::string folder{};                            ///< where to run; empty: here
  bool terminal = false;                           ///< standard error is a pseudo-terminal
  std::string both_to{};                           ///< both streams into this file, as with > FILE 2>&1
  std::string interrupt_at{};                      ///< send SIGINT when standard error first contains this
  int interrupts = 1;                              ///< how many, 50 ms apart
  std::optional<std::uint64_t> file_size_limit{};  ///< RLIMIT_FSIZE, bytes
  std::optional<std::uint64_t> memory_limit{};     ///< RLIMIT_AS, bytes
  double timeout_s = 300;                          ///< then the process is killed and the test fails
};

struct RunResult {
  int status = -1;  ///< exit status; -1 if a signal or the timeout ended it
  std::string out;
  std::string err;
};

/// Runs `scantet` with the arguments. The environment is that of the test.
RunResult run_scantet(const std::vector<std::string>& arguments, const RunOptions& options = {});

/// A fresh, empty folder for the running test, removed by the destructor.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }
  /// Names of everything in it, hidden files included, sorted.
  std::vector<std::string> names() const;

 private:
  std::string path_;
};

/// A file of sample_volumes/.
std::string sample(const std::string& name);

std::string read_bytes(const std::string& file);
void write_bytes(const std::string& file, const std::string& bytes);

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace scantet
