// A plugin is code that the program trusts; one with an error or a damaged byte in a function that its trial does not
// call crashes here. The text is made beforehand, and the handler has a stack of its own, so that recursion without
// end is heard of, too: only async-signal-safe calls are allowed in it.
#include "scantet/cli/crash.h"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

#include "scantet/base/error.h"
#include "scantet/io/atomic_file.h"

namespace scantet {
namespace {

constexpr std::size_t kRoom = 1024;
std::array<char, kRoom> suspects{};
std::array<char, 1 << 16> stack;

const char* name_of(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "segmentation fault";
    case SIGBUS:
      return "bus error";
    case SIGFPE:
      return "arithmetic error";
    case SIGILL:
      return "illegal instruction";
    default:
      return "abort";
  }
}

void say(const char* text) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
}

void handle(int signal) {
  remove_unfinished_files();
  say("\nscantet: error: internal error: crashed: ");
  say(name_of(signal));
  if (suspects[0] != '\0') {
    say(", perhaps in a plugin:");
    say(suspects.data());
    say("\nscantet: hint: try without the plugin, and tell its author\n");
  } else {
    say("\nscantet: hint: please report this, with the command and the version\n");
  }
  _exit(static_cast<int>(Fault::internal));
}

}  // namespace

void install_crash_handlers() {
  stack_t own{};
  own.ss_sp = stack.data();
  own.ss_size = stack.size();
  sigaltstack(&own, nullptr);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_DFL) continue;
    action.sa_handler = handle;
    action.sa_flags = SA_ONSTACK | static_cast<int>(SA_RESETHAND);
    sigaction(signal, &action, nullptr);
  }
}

void suspect_plugin(const std::string& file) {
  const std::size_t used = std::strlen(suspects.data());
  const std::string text = " " + file;
  if (used + text.size() < kRoom) std::memcpy(suspects.data() + used, text.c_str(), text.size() + 1);
}

}  // namespace scantet
