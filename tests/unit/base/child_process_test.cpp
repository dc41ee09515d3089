// Whatever happens in the child, the parent hears of it and lives on.
#include "scantet/base/child_process.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/base/sanitizers.h"
#include "scantet/base/stopwatch.h"

namespace scantet {
namespace {

/// What becomes of the work, as the rest of a sentence; empty if it comes to its end.
std::string fate_of(const std::function<void(ChildLine&)>& work, const ChildLimits& limits = {}) {
  ChildProcess child(limits, work);
  try {
    child.await_step();
    return {};
  } catch (const ChildFailure& failure) {
    return failure.what();
  }
}

TEST(ChildProcess, SendsWhatItMade) {
  std::vector<int> numbers(300'000);
  for (int n = 0; n < 300'000; ++n) numbers[static_cast<std::size_t>(n)] = n;
  std::string noted;
  ChildProcess child({}, [&](ChildLine& line) {
    line.note("counting", 3, 4);
    line.step();
    line.put_text("made");
    line.send(numbers.data(), numbers.size() * sizeof(int));
  });
  child.await_step([&](const std::string& doing, std::uint64_t done, std::uint64_t total) {
    noted = doing + std::to_string(done) + "/" + std::to_string(total);
  });
  EXPECT_EQ(noted, "counting3/4");
  std::vector<int> taken(numbers.size());
  const std::string text = child.take([&](ChildLine& line) {
    std::string first = line.take_text();
    line.receive(taken.data(), taken.size() * sizeof(int));
    return first;
  });
  EXPECT_EQ(text, "made");
  EXPECT_EQ(taken, numbers);
}

TEST(ChildProcess, EndsAreNamed) {
  EXPECT_EQ(fate_of([](ChildLine&) {}), "");
  EXPECT_EQ(fate_of([](ChildLine&) { std::raise(SIGKILL); }), "crashes: Killed");
  EXPECT_EQ(fate_of([](ChildLine&) { _exit(7); }), "ends the process, with status 7");
  EXPECT_EQ(fate_of([](ChildLine&) { throw std::runtime_error("spilt milk"); }), "throws: spilt milk");
  EXPECT_EQ(fate_of([](ChildLine&) { pause(); }, {0, 1, 0}), "does not end within 1 s");
  const auto busy = [](ChildLine&) {
    for (volatile bool on = true; on;) {
    }
  };
  EXPECT_EQ(fate_of(busy, {1, 0, 0}), "does not end within 1 s of processor time");
}

TEST(ChildProcess, SleepForEverIsEnded) {
  std::mutex held;
  held.lock();
  const auto deadlock = [&](ChildLine&) { held.lock(); };
  EXPECT_EQ(fate_of(deadlock, {10, 0, 0, 1}), "waits, without doing anything, for more than 1 s");
  const auto slow = [](ChildLine& line) {  // it is heard of now and then
    for (int n = 0; n < 4; ++n) {
      usleep(600'000);
      line.note("sleeping", 0, 0);
    }
  };
  EXPECT_EQ(fate_of(slow, {10, 0, 0, 1}), "");
  const auto busy = [](ChildLine&) {
    const Stopwatch watch;
    while (watch.seconds() < 2) {
    }
  };
  EXPECT_EQ(fate_of(busy, {10, 0, 0, 1}), "");
}

TEST(ChildProcess, ErrorsComeOutWhole) {
  ChildProcess child({}, [](ChildLine&) { throw Error(Fault::input, "input.nan", "a.nrrd: no number", "mend it"); });
  try {
    child.await_step();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_EQ(error.code(), "input.nan");
    EXPECT_STREQ(error.what(), "a.nrrd: no number; mend it");
    EXPECT_EQ(error.remedy(), "mend it");
  }
}

TEST(ChildProcess, MemoryIsLimited) {
#if defined(SCANTET_IS_SANITIZED)
  GTEST_SKIP() << "a sanitizer's build has no limit";
#endif
  constexpr std::size_t kMega = 1 << 20;
  const auto take = [](std::size_t bytes) {
    return [bytes](ChildLine&) {
      const std::unique_ptr<void, void (*)(void*)> memory(std::malloc(bytes), std::free);
      void* volatile const seen = memory.get();  // volatile: else a compiler may leave both calls out
      if (seen == nullptr) throw std::runtime_error("no memory");
    };
  };
  EXPECT_EQ(fate_of(take(64 * kMega), {10, 0, 128.0 * kMega}), "");
  EXPECT_EQ(fate_of(take(256 * kMega), {10, 0, 128.0 * kMega}), "throws: no memory");
}

TEST(ChildProcess, StopsWhenAskedTo) {
  const Stopwatch watch;
  ChildProcess child(
      {}, [](ChildLine&) { pause(); }, [&] { return watch.seconds() > 0.2; });
  EXPECT_THROW(child.await_step(), ChildStopped);
}

TEST(ChildProcess, SendingToAChildThatTakesNothingEnds) {
  const std::vector<char> much(8 << 20);
  const auto send = [&](ChildLine& line) { line.send(much.data(), much.size()); };
  const auto sleep = [](ChildLine&) { pause(); };
  const Stopwatch watch;
  ChildProcess stopped({0, 10, 0}, sleep, [&] { return watch.seconds() > 0.2; });
  EXPECT_THROW(stopped.take(send), ChildStopped);
  ChildProcess idle({0, 10, 0, 1}, sleep);
  try {
    idle.take(send);
    ADD_FAILURE() << "all is sent";
  } catch (const ChildFailure& failure) {
    EXPECT_STREQ(failure.what(), "waits, without doing anything, for more than 1 s");
  }
}

TEST(ChildProcess, ALineWithoutAChildIsNoOthersLine) {
  ChildProcess child({}, [](ChildLine&) { _exit(7); });
  EXPECT_THROW(child.await_step(), ChildFailure);
  std::array<int, 2> others;  // the first gets the number that the line had
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, others.data()), 0);
  EXPECT_THROW(child.line().put('x'), ChildFailure);
  EXPECT_THROW(child.take([](ChildLine& line) { line.put('x'); }), ChildFailure);
  for (const int descriptor : others) close(descriptor);
}

TEST(ChildProcess, TakesMoreThanTheLineHolds) {
  std::vector<int> numbers(1'000'000);
  for (std::size_t n = 0; n < numbers.size(); ++n) numbers[n] = static_cast<int>(n);
  ChildProcess child({}, [&](ChildLine& line) {
    std::vector<int> taken(numbers.size());
    line.receive(taken.data(), taken.size() * sizeof(int));
    line.put(taken == numbers);
  });
  child.take([&](ChildLine& line) { line.send(numbers.data(), numbers.size() * sizeof(int)); });
  EXPECT_TRUE(child.take([](ChildLine& line) { return line.take<bool>(); }));
}

}  // namespace
}  // namespace scantet
