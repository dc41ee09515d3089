// One line on the terminal that says where the computation stands.
#pragma once

#include <chrono>
#include <string>

#include "scantet/base/progress.h"

namespace scantet {

/// Cancels on Ctrl-C, and, if `visible`, keeps one line of standard error up to date: stage, rule, vertices, elements
/// still pending, vertices a second, and an estimate of the time left. Redrawn at most ten times a second; gone when
/// the object is.
class ProgressLine final : public Progress {
 public:
  explicit ProgressLine(bool visible) : visible_(visible) {}
  ~ProgressLine() override { clear(); }

  void report(const ProgressState& state) override;
  bool cancelled() const override;
  /// Wipes the line, before other output.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string line(const ProgressState& state, double now_s);
  void start_stage(const ProgressState& state, double now_s);
  void measure(const ProgressState& state, double now_s);

  bool visible_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  double drawn_s_ = -1;  // when the line was last drawn, seconds since start_
  std::string stage_;
  std::string doing_;
  double measured_s_ = 0;  // when the rates were last brought up to date
  std::uint64_t measured_done_ = 0;
  std::uint64_t measured_pending_ = 0;
  double done_rate_ = 0;     // per second, smoothed; 0: not known yet
  double pending_rate_ = 0;  // how fast `pending` shrinks, per second, smoothed
};

/// True if standard error is a terminal.
bool error_is_terminal();

}  // namespace scantet
