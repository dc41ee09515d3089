// oneTBB does the work: an arena bounds the threads, pieces of fixed size are handed out as they are asked for.
#include "scantet/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

namespace scantet {

void with_threads(std::size_t threads, const std::function<void()>& work) {
  constexpr std::size_t kMost = 256;
  const std::size_t wanted = threads > 0 ? std::min(threads, kMost) : std::thread::hardware_concurrency();
  const std::size_t count = std::max<std::size_t>(wanted, 1);
  // Without this oneTBB would keep to one thread a core even if more are asked for.
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, count);
  tbb::task_arena arena(static_cast<int>(count));
  arena.execute(work);
}

int thread_count() {
  return tbb::this_task_arena::max_concurrency();
}

void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t pieces = (count + grain - 1) / grain;
  if (pieces == 0) return;
  if (pieces == 1) return body(0, count);
  tbb::parallel_for(
      std::size_t{0}, pieces, [&](std::size_t i) { body(i * grain, std::min(count, (i + 1) * grain)); },
      tbb::simple_partitioner());
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
  tbb::parallel_invoke(first, second);
}

}  // namespace scantet
