// Processor time is the system's count for the whole process.
#include "scantet/base/phase_clock.h"

#include <ctime>

namespace scantet {
namespace {

double process_seconds() {
  timespec time{};
  if (clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

void PhaseClock::begin(const char* stage, const std::string& part, std::uint64_t weight) {
  end();
  weight_ = weight;
  progress_.report({stage, part, done_, total_, 0});
  current_ = PhaseAccount{stage, part, 0, process_seconds()};
  watch_ = Stopwatch();
}

void PhaseClock::end() {
  if (!current_) return;
  current_->seconds = watch_.seconds();
  current_->cpu_seconds = process_seconds() - current_->cpu_seconds;
  accounts_.push_back(std::move(*current_));
  current_.reset();
  done_ += weight_;
}

}  // namespace scantet
