// Progress as 3D Slicer reads it from a module's standard output.
#pragma once

#include <chrono>
#include <string>

#include "scantet/base/progress.h"

namespace scantet {

/// Cancels on Ctrl-C and SIGTERM, which is how Slicer ends a module. Prints <filter-start> when made, <filter-progress>
/// from 0 to 1 at most ten times a second, never less than before, and <filter-end> when destroyed.
class SlicerProgress final : public Progress {
 public:
  explicit SlicerProgress(std::string name);
  ~SlicerProgress() override;
  SlicerProgress(const SlicerProgress&) = delete;
  SlicerProgress& operator=(const SlicerProgress&) = delete;

  void report(const ProgressState& state) override;
  bool cancelled() const override;

 private:
  using Clock = std::chrono::steady_clock;
  double passed_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  std::string name_;
  Clock::time_point start_ = Clock::now();
  double printed_ = 0;     // the share that was told last
  double printed_s_ = -1;  // when, seconds since start_
};

}  // namespace scantet
