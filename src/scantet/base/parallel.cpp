// oneTBB does the work: an arena bounds the threads, pieces of fixed size are handed out as they are asked for.
#include "scantet/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace scantet {
namespace {

/// What orders the pieces of a loop after what comes before the loop and before what comes after it. oneTBB does that
/// itself; ThreadSanitizer does not see it, as Debian's oneTBB is not built for it.
class Order {
 public:
#if defined(__SANITIZE_THREAD__)
  Order() {
    __tsan_release(&begun_);
  }
  ~Order() {
    __tsan_acquire(&done_);
  }
  void piece_begins() {
    __tsan_acquire(&begun_);
  }
  void piece_ends() {
    __tsan_release(&done_);
  }

 private:
  char begun_ = 0;
  char done_ = 0;
#else
  static void piece_begins() {}
  static void piece_ends() {}
#endif
};

}  // namespace

void with_threads(std::size_t threads, const std::function<void()>& work) {
  constexpr std::size_t kMost = 256;
  const std::size_t wanted = threads > 0 ? std::min(threads, kMost) : std::thread::hardware_concurrency();
  const std::size_t count = std::max<std::size_t>(wanted, 1);
  // Without this oneTBB would keep to one thread a core even if more are asked for.
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, count);
  tbb::task_arena arena(static_cast<int>(count));
  Order order;
  arena.execute([&] {
    order.piece_begins();
    work();
    order.piece_ends();
  });
}

int thread_count() {
  return tbb::this_task_arena::max_concurrency();
}

void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t pieces = (count + grain - 1) / grain;
  if (pieces == 0) return;
  if (pieces == 1) return body(0, count);
  Order order;
  const auto run_piece = [&](std::size_t i) {
    order.piece_begins();
    body(i * grain, std::min(count, (i + 1) * grain));
    order.piece_ends();
  };
  tbb::parallel_for(std::size_t{0}, pieces, run_piece, tbb::simple_partitioner());
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
  Order order;
  const auto ordered = [&order](const std::function<void()>& work) {
    order.piece_begins();
    work();
    order.piece_ends();
  };
  tbb::parallel_invoke([&] { ordered(first); }, [&] { ordered(second); });
}

}  // namespace scantet
