// The handler only sets a flag, which Progress::cancelled() polls. A second signal removes the temporary output files,
// with nothing but async-signal-safe calls, and leaves.
#include "scantet/cli/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "scantet/cli/command.h"
#include "scantet/io/atomic_file.h"

namespace scantet {
namespace {

std::atomic<bool> g_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "needed in a signal handler");

void handle(int) {
  if (g_interrupted.exchange(true)) {
    remove_unfinished_files();
    _exit(kExitCancelled);
  }
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = 0;  // a call that waits, for a file that does not come, ends with an error
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() {
  return g_interrupted.load(std::memory_order_relaxed);
}

}  // namespace scantet
