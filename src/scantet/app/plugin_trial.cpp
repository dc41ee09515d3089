// The child says through a pipe that it came to the end; whatever else happens to it (a signal, exit, an exception,
// even one thrown by a static object while the library is loaded, which nobody can catch) is seen from outside. An
// exception is named by the terminate handler: act() is called from a function that lets none out.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>

#include "scantet/app/plugin_trial_impl.h"
#include "scantet/base/error.h"

namespace scantet {
namespace {

constexpr unsigned kMost_s = 10;
constexpr char kDone = '.';
int result_pipe = -1;  // of the child

[[noreturn]] void say(const std::string& text) {
  const auto written = write(result_pipe, text.data(), text.size());
  _exit(written == static_cast<ssize_t>(text.size()) ? 0 : 1);
}

[[noreturn]] void name_exception() {
  std::string text = "calls std::terminate";
  try {
    if (const auto exception = std::current_exception()) std::rethrow_exception(exception);
  } catch (const std::exception& error) {
    text = std::string("throws: ") + error.what();
  } catch (...) {
    text = "throws something that is no std::exception";
  }
  say(text);
}

// The child inherits the program's signal handlers and its terminal; neither is for the plugin.
void be_quiet() {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) std::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  alarm(kMost_s);
}

[[noreturn]] void be_child(const std::function<void()>& act) noexcept {
  be_quiet();
  std::set_terminate(name_exception);
  act();
  say(std::string(1, kDone));
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 512> buffer;
  while (true) {
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
  }
}

std::string ending(const std::string& said, int status) {
  if (said == std::string(1, kDone)) return {};
  if (!said.empty()) return said;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    return "does not end within " + std::to_string(kMost_s) + " s";
  if (WIFSIGNALED(status)) return std::string("crashes: ") + strsignal(WTERMSIG(status));
  return "ends the process, with status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

std::string try_in_child(const std::function<void()>& act) {
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(Fault::internal, "internal.pipe", "no pipe can be made");
  const pid_t child = fork();
  if (child < 0) {
    close(ends[0]);
    close(ends[1]);
    throw Error(Fault::internal, "internal.fork", "no child process can be made");
  }
  if (child == 0) {
    result_pipe = ends[1];
    be_child(act);
  }
  close(ends[1]);
  const std::string said = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return ending(said, status);
}

}  // namespace scantet
