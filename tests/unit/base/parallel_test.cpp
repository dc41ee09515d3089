#include "scantet/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <random>
#include <set>
#include <stdexcept>
#include <thread>

#include "scantet/base/large_pages.h"

namespace scantet {
namespace {

TEST(Parallel, PiecesCoverTheRangeAndDoNotDependOnThreads) {
  for (const std::size_t threads : {1, 2, 5}) {
    std::mutex mutex;
    std::set<std::pair<std::size_t, std::size_t>> pieces;
    with_threads(threads, [&] {
      EXPECT_EQ(thread_count(), static_cast<int>(threads));
      parallel_for(1003, 100, [&](std::size_t begin, std::size_t end) {
        const std::lock_guard lock(mutex);
        pieces.insert({begin, end});
      });
    });
    ASSERT_EQ(pieces.size(), 11U);
    std::size_t next = 0;
    for (const auto& [begin, end] : pieces) {
      EXPECT_EQ(begin, next);
      next = end;
    }
    EXPECT_EQ(next, 1003U);
  }
  parallel_for(0, 10, [](std::size_t, std::size_t) { FAIL(); });
}

/// Cancelled after some questions.
class Soon final : public Progress {
 public:
  bool cancelled() const override { return asked_++ >= 3; }

 private:
  mutable std::atomic<int> asked_ = 0;
};

TEST(Parallel, InterruptedWorkEndsWithItsLoop) {
  const Soon progress;
  std::atomic<int> pieces = 0;
  bool is_past = false;
  const bool done = run_interruptible(progress, [&] {
    parallel_for(1000, 1, [&](std::size_t, std::size_t) { ++pieces; });
    is_past = true;
  });
  EXPECT_FALSE(done);
  EXPECT_FALSE(is_past);
  EXPECT_EQ(pieces, 3);
  parallel_for(10, 1, [&](std::size_t, std::size_t) { ++pieces; });
  EXPECT_EQ(pieces, 13) << "later loops are as ever";
  const Progress never;
  EXPECT_TRUE(run_interruptible(never, [] { parallel_for(10, 1, [](std::size_t, std::size_t) {}); }));
}

TEST(Parallel, AsManyThreadsAsAskedForWorkAtOnce) {
  std::atomic<int> present = 0;
  with_threads(3, [&] {
    parallel_for(3, 1, [&](std::size_t, std::size_t) {
      ++present;
      const auto start = std::chrono::steady_clock::now();
      while (present < 3 && std::chrono::steady_clock::now() - start < std::chrono::seconds(20)) {
        std::this_thread::yield();
      }
    });
  });
  EXPECT_EQ(present, 3);
}

TEST(Parallel, ThrowsWhatAPieceThrows) {
  const int before = thread_count();
  EXPECT_THROW(with_threads(2,
                            [] {
                              parallel_for(100, 1, [](std::size_t i, std::size_t) {
                                if (i == 57) throw std::runtime_error("57");
                              });
                            }),
               std::runtime_error);
  EXPECT_EQ(thread_count(), before) << "later work is as ever";
}

TEST(Parallel, SortsAsStdSortDoes) {
  std::mt19937 random(2);
  for (const std::size_t count : {0U, 1U, 16384U, 100001U}) {
    std::vector<std::uint32_t> values(count);
    for (std::uint32_t& value : values) value = random();
    std::vector<std::uint32_t> expected = values;
    std::sort(expected.begin(), expected.end());
    parallel_sort(values, std::less<>());
    EXPECT_TRUE(values == expected) << count;
  }
}

TEST(LargePages, HoldsWhatItIsGivenAndStartsOnACacheLine) {
  for (const std::size_t count : {10U, 1'000'000U}) {
    LargeVector<std::uint64_t> values(count, 7);
    for (std::size_t i = 0; i < count; ++i) values.push_back(i);
    EXPECT_EQ(values[count - 1], 7U);
    EXPECT_EQ(values.back(), count - 1);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(values.data()) % 64, 0U);
  }
}

}  // namespace
}  // namespace scantet
