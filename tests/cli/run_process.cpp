// fork and exec with both output streams read through poll, so that a test can act on what appears.
#include "run_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace scantet {
namespace {

using Clock = std::chrono::steady_clock;

struct Streams {
  int parent_out = -1, child_out = -1;
  int parent_err = -1, child_err = -1;
};

Streams open_streams(bool terminal) {
  Streams streams;
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) std::abort();
  streams.parent_out = ends[0];
  streams.child_out = ends[1];
  if (terminal) {
    winsize size{24, 200, 0, 0};
    if (openpty(&streams.parent_err, &streams.child_err, nullptr, nullptr, &size) != 0) std::abort();
  } else {
    if (pipe2(ends, O_CLOEXEC) != 0) std::abort();
    streams.parent_err = ends[0];
    streams.child_err = ends[1];
  }
  return streams;
}

[[noreturn]] void become_scantet(const std::vector<std::string>& arguments, const RunOptions& options,
                                 const Streams& streams) {
  if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(125);
  if (options.file_size_limit) {
    const rlimit limit{*options.file_size_limit, *options.file_size_limit};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(125);
  }
  if (options.memory_limit) {
    const rlimit limit{*options.memory_limit, *options.memory_limit};
    if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(125);
  }
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(streams.child_out, STDOUT_FILENO);
  dup2(streams.child_err, STDERR_FILENO);
  if (!options.both_to.empty()) {
    dup2(open(options.both_to.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(STDOUT_FILENO, STDERR_FILENO);
  }
  close(streams.parent_err);
  std::vector<char*> words{const_cast<char*>(SCANTET_EXECUTABLE)};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  execv(SCANTET_EXECUTABLE, words.data());
  _exit(126);
}

// False at the end of the stream.
bool read_some(int descriptor, std::string& text) {
  char buffer[4096];
  const ssize_t count = read(descriptor, buffer, sizeof buffer);
  if (count <= 0) return false;  // a pseudo-terminal ends with an error, EIO
  text.append(buffer, static_cast<std::size_t>(count));
  return true;
}

void send_interrupts(pid_t child, int count) {
  for (int i = 0; i < count; ++i) {
    if (i > 0) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    kill(child, SIGINT);
  }
}

}  // namespace

RunResult run_scantet(const std::vector<std::string>& arguments, const RunOptions& options) {
  const Streams streams = open_streams(options.terminal);
  const pid_t child = fork();
  if (child == 0) become_scantet(arguments, options, streams);
  close(streams.child_out);
  close(streams.child_err);

  RunResult result;
  pollfd watched[2] = {{streams.parent_out, POLLIN, 0}, {streams.parent_err, POLLIN, 0}};
  const auto deadline = Clock::now() + std::chrono::duration<double>(options.timeout_s);
  bool interrupted = options.interrupt_at.empty();
  bool killed = false;
  while (watched[0].fd >= 0 || watched[1].fd >= 0) {
    poll(watched, 2, 100);
    if (watched[0].revents != 0 && !read_some(watched[0].fd, result.out)) watched[0].fd = -1;
    if (watched[1].revents != 0 && !read_some(watched[1].fd, result.err)) watched[1].fd = -1;
    if (!interrupted && result.err.find(options.interrupt_at) != std::string::npos) {
      interrupted = true;
      send_interrupts(child, options.interrupts);
    }
    if (!killed && Clock::now() > deadline) {
      killed = true;
      kill(child, SIGKILL);
      ADD_FAILURE() << "killed after " << options.timeout_s << " s";
    }
  }
  close(streams.parent_out);
  close(streams.parent_err);
  int status = 0;
  waitpid(child, &status, 0);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

TestFolder::TestFolder() {
  std::string pattern = testing::TempDir() + "scantet_cli_XXXXXX";
  if (mkdtemp(pattern.data()) == nullptr) std::abort();
  path_ = pattern;
}

TestFolder::~TestFolder() {
  std::error_code code;
  std::filesystem::permissions(path_, std::filesystem::perms::owner_all, code);
  std::filesystem::remove_all(path_, code);
}

std::vector<std::string> TestFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

std::string sample(const std::string& name) {
  return std::string(SCANTET_SAMPLES) + "/" + name;
}

std::string read_bytes(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

void write_bytes(const std::string& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace scantet
