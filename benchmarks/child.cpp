#include "child.h"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace scantet::bench {
namespace {

constexpr int kDone = 0;
constexpr int kThrew = 1;

void write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(file, text.data(), text.size());
    if (written <= 0) _exit(kThrew);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// Writes to more memory than any run here takes, and gives it back. On a virtual machine the host hands memory over
/// when it is first written, page by page and slowly, and takes it back when it lies idle: without this a run would be
/// timed with that or without it, by what ran before.
void warm_memory() {
  constexpr std::size_t kBytes = std::size_t{1} << 30;
  void* const memory = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return;  // then as it is
  madvise(memory, kBytes, MADV_HUGEPAGE);
  std::memset(memory, 1, kBytes);
  munmap(memory, kBytes);
}

[[noreturn]] void run_child(const std::function<std::string()>& work, int out) {
  warm_memory();
  int status = kDone;
  std::string text;
  try {
    text = work();
  } catch (const std::exception& error) {
    text = error.what();
    status = kThrew;
  }
  write_all(out, text);
  _exit(status);
}

std::string read_all(int file) {
  std::string text;
  char buffer[4096];
  for (ssize_t got = 0; (got = read(file, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(got));
  return text;
}

}  // namespace

std::string in_child(const std::function<std::string()>& work) {
  int ends[2];
  if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  std::fflush(nullptr);  // or the child would print it again
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) {
    close(ends[0]);
    run_child(work, ends[1]);
  }
  close(ends[1]);
  std::string text = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) throw std::runtime_error("ended by signal " + std::to_string(WTERMSIG(status)));
  if (WEXITSTATUS(status) != kDone) throw std::runtime_error(text);
  return text;
}

}  // namespace scantet::bench
