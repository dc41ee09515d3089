// Python handles signals on its main thread alone, between its own instructions; a computation on that thread would
// have to come back there from deep within its loops. So it has a thread of its own, and the caller's does nothing but
// look.
#include "watched_run.h"

#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "arrays.h"

namespace scantet::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kLook{50};

struct State {
  std::string stage;
  std::string doing;
  std::uint64_t done = 0;
  std::optional<std::uint64_t> total;
  std::uint64_t pending = 0;
};

/// Keeps the last that was said, until somebody looks.
class WatchedProgress final : public Progress {
 public:
  void report(const ProgressState& state) override {
    const std::lock_guard lock(mutex_);
    last_ = State{std::string(state.stage), std::string(state.doing), state.done, state.total, state.pending};
  }
  bool cancelled() const override { return cancelled_.load(std::memory_order_relaxed); }
  void cancel() { cancelled_ = true; }
  std::optional<State> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(last_, std::nullopt);
  }

 private:
  std::mutex mutex_;
  std::optional<State> last_;
  std::atomic<bool> cancelled_{false};
};

/// The interrupt is for the thread that looks for it: a call of another one that waits is not to end by it.
class WithoutInterrupt {
 public:
  WithoutInterrupt() {
    sigset_t interrupt;
    sigemptyset(&interrupt);
    sigaddset(&interrupt, SIGINT);
    pthread_sigmask(SIG_BLOCK, &interrupt, &before_);
  }
  ~WithoutInterrupt() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  WithoutInterrupt(const WithoutInterrupt&) = delete;
  WithoutInterrupt& operator=(const WithoutInterrupt&) = delete;

 private:
  sigset_t before_{};
};

/// The work on its thread.
class Worker {
 public:
  explicit Worker(const std::function<void()>& work) {
    const WithoutInterrupt inherited;
    thread_ = std::thread([this, work] {
      try {
        work();
      } catch (...) {
        failure_ = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      is_done_ = true;
      done_.notify_one();
    });
  }
  /// Whether it has ended by then.
  bool wait() {
    std::unique_lock lock(mutex_);
    return done_.wait_for(lock, kLook, [&] { return is_done_; });
  }
  std::exception_ptr join() {
    thread_.join();
    return failure_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

void look(const py::object& listener, WatchedProgress& progress) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (listener.is_none()) return;
  const std::optional<State> state = progress.take();
  if (state) listener(text(state->stage), text(state->doing), state->done, state->total, state->pending);
}

}  // namespace

void run_watched(const py::object& listener, const std::function<void(Progress&)>& work) {
  WatchedProgress progress;
  Worker worker([&] { work(progress); });
  std::exception_ptr raised;
  for (bool is_done = false; !is_done;) {
    {
      const py::gil_scoped_release released;
      is_done = worker.wait();
    }
    if (is_done || raised) continue;
    try {
      look(listener, progress);
    } catch (...) {
      raised = std::current_exception();
      progress.cancel();
    }
  }
  const std::exception_ptr failure = worker.join();
  if (raised) std::rethrow_exception(raised);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace scantet::python
