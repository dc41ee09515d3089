// The clock is read at every question, which costs little. The memory is looked at twenty times a second at most, for
// that takes reading a file of the system.
#include "scantet/base/budget.h"

#include "scantet/base/memory.h"

namespace scantet {

void Budget::report(const ProgressState& state) {
  if (over_ == End::none) {
    const std::lock_guard lock(mutex_);
    busy_with_ = state.stage;
    if (!state.doing.empty()) busy_with_.append(" ").append(state.doing);
  }
  inner_.report(state);
}

bool Budget::out_of_budget() const {
  const End why = end();
  return why == End::time || why == End::memory;
}

Budget::End Budget::end() const {
  if (inner_.cancelled()) return End::cancelled;
  if (over_ != End::none || closed_ || (!time_s_ && !memory_bytes_)) return over_;
  const double now_s = std::chrono::duration<double>(Clock::now() - start_).count();
  if (time_s_ && now_s >= *time_s_) {
    over_ = End::time;
  } else if (memory_bytes_ && is_memory_over(now_s)) {
    over_ = End::memory;
  }
  return over_;
}

bool Budget::is_memory_over(double now_s) const {
  constexpr double kEvery_s = 0.05;
  double looked_s = looked_s_;
  if (looked_s >= 0 && now_s - looked_s < kEvery_s) return false;
  if (!looked_s_.compare_exchange_strong(looked_s, now_s)) return false;  // another thread looks
  return resident_bytes() > *memory_bytes_;
}

std::string Budget::busy_with() const {
  const std::lock_guard lock(mutex_);
  return busy_with_;
}

}  // namespace scantet
