// oneTBB does the work: an arena bounds the threads, and pieces of fixed size are handed out as they are asked for.
// ThreadSanitizer does not see how oneTBB orders its tasks, as Debian's oneTBB is not built for it; in a build with
// ThreadSanitizer, plain threads do the same.
#include "scantet/base/parallel.h"

#include <algorithm>
#include <thread>
#include <utility>

#if defined(__SANITIZE_THREAD__)
#include <atomic>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace scantet {
namespace {

std::size_t threads_for(std::size_t wanted) {
  constexpr std::size_t kMost = 256;
  const std::size_t count = wanted > 0 ? std::min(wanted, kMost) : std::thread::hardware_concurrency();
  return std::max<std::size_t>(count, 1);
}

/// Ends the work of run_interruptible; nothing else catches it.
struct Interrupted {};

thread_local const Progress* interrupting = nullptr;  // loops started on this thread

/// Asked before each piece.
void poll(const Progress* progress) {
  if (progress != nullptr && progress->cancelled()) throw Interrupted();
}

}  // namespace

bool run_interruptible(const Progress& progress, const std::function<void()>& work) {
  const Progress* const before = std::exchange(interrupting, &progress);
  bool done = true;
  try {
    work();
  } catch (const Interrupted&) {
    done = false;
  } catch (...) {
    interrupting = before;
    throw;
  }
  interrupting = before;
  return done && !progress.cancelled();
}

#if defined(__SANITIZE_THREAD__)

namespace {

thread_local std::size_t allowed = 0;  // threads for loops started here; 0: as many as there are cores

/// Runs work(i) for i < count.
void run_all(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  const std::size_t threads = std::min(threads_for(allowed), count);
  std::vector<std::exception_ptr> errors(threads);
  const auto run = [&](std::size_t thread) {
    allowed = 1;  // loops within a piece stay on its thread
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      errors[thread] = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  for (std::size_t thread = 1; thread < threads; ++thread) others.emplace_back(run, thread);
  const std::size_t before = allowed;
  run(0);
  allowed = before;
  for (std::thread& other : others) other.join();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace

void with_threads(std::size_t threads, const std::function<void()>& work) {
  const std::size_t before = std::exchange(allowed, threads_for(threads));
  try {
    work();
  } catch (...) {
    allowed = before;
    throw;
  }
  allowed = before;
}

int thread_count() {
  return static_cast<int>(threads_for(allowed));
}

void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  const Progress* const progress = interrupting;
  run_all((count + grain - 1) / grain, [&](std::size_t i) {
    poll(progress);
    body(i * grain, std::min(count, (i + 1) * grain));
  });
}

#else

void with_threads(std::size_t threads, const std::function<void()>& work) {
  const std::size_t count = threads_for(threads);
  // Without this oneTBB would keep to one thread a core even if more are asked for.
  const tbb::global_control most(tbb::global_control::max_allowed_parallelism, count);
  tbb::task_arena arena(static_cast<int>(count));
  arena.execute(work);
}

int thread_count() {
  return tbb::this_task_arena::max_concurrency();
}

void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t pieces = (count + grain - 1) / grain;
  const Progress* const progress = interrupting;
  const auto run_piece = [&](std::size_t i) {
    poll(progress);
    body(i * grain, std::min(count, (i + 1) * grain));
  };
  if (pieces == 1) run_piece(0);
  if (pieces > 1) tbb::parallel_for(std::size_t{0}, pieces, run_piece, tbb::simple_partitioner());
}

#endif

}  // namespace scantet
