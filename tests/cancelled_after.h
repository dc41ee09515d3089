// Cancelling at every stage of something long, without a clock.
#pragma once

#include <gtest/gtest.h>

#include <atomic>

#include "scantet/base/progress.h"

namespace scantet::test {

/// Cancelled once it has been asked `polls` times.
class CancelledAfter final : public Progress {
 public:
  explicit CancelledAfter(int polls) : left_(polls) {}
  bool cancelled() const override { return left_.fetch_sub(1) <= 0; }
  bool was_cancelled() const { return left_ < 0; }
  int left() const { return left_; }

 private:
  mutable std::atomic<int> left_;
};

/// Calls act(progress), which tells whether it made something, cancelled ever later until it is not. It must make
/// nothing if cancelled, and ask at least `least` times.
template <class Act>
void expect_cancellable(int least, const Act& act) {
  constexpr int kMost = 1 << 26;
  for (int polls = 0; polls < kMost; polls = 2 * polls + 1) {
    CancelledAfter progress(polls);
    const bool made = act(progress);
    EXPECT_NE(made, progress.was_cancelled()) << "cancelled after " << polls << " questions";
    if (progress.was_cancelled()) continue;
    EXPECT_GT(polls, least / 2);
    return;
  }
  ADD_FAILURE() << "it does not end";
}

}  // namespace scantet::test
