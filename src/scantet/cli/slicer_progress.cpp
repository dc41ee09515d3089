#include "scantet/cli/slicer_progress.h"

#include <algorithm>
#include <utility>

#include "scantet/base/options.h"
#include "scantet/cli/interrupt.h"
#include "scantet/cli/print.h"

namespace scantet {
namespace {

constexpr double kEvery_s = 0.1;
constexpr double kLeastStep = 0.01;

struct StageShare {
  const char* stage;
  double begin;
  double end;
};

// What stages usually take of the whole.
constexpr StageShare kStages[] = {{"read", 0, 0.1},        {"sample", 0.1, 0.2},  {"refine", 0.2, 0.6},
                                  {"optimize", 0.6, 0.85}, {"audit", 0.85, 0.95}, {"write", 0.95, 1}};

double share_of(const ProgressState& state) {
  const auto* const stage =
      std::find_if(std::begin(kStages), std::end(kStages), [&](const StageShare& s) { return s.stage == state.stage; });
  if (stage == std::end(kStages)) return 0;
  double part = 0;
  if (state.total && *state.total > 0) {
    part = static_cast<double>(state.done) / static_cast<double>(*state.total);
  } else if (state.pending > 0) {
    part = static_cast<double>(state.done) / static_cast<double>(state.done + state.pending);
  }
  return stage->begin + std::clamp(part, 0.0, 1.0) * (stage->end - stage->begin);
}

}  // namespace

SlicerProgress::SlicerProgress(std::string name) : name_(std::move(name)) {
  print("<filter-start>\n<filter-name>" + name_ + "</filter-name>\n<filter-comment> \"meshing\" </filter-comment>\n" +
        "</filter-start>\n");
}

SlicerProgress::~SlicerProgress() {
  print("<filter-end>\n<filter-name>" + name_ + "</filter-name>\n<filter-time>" + number_text(passed_s(), 3) +
        "</filter-time>\n</filter-end>\n");
}

bool SlicerProgress::cancelled() const {
  return interrupted();
}

void SlicerProgress::report(const ProgressState& state) {
  const double share = share_of(state);
  const double now_s = passed_s();
  if (share < printed_ + kLeastStep || now_s < printed_s_ + kEvery_s) return;
  printed_ = share;
  printed_s_ = now_s;
  print("<filter-progress>" + number_text(share, 3) + "</filter-progress>\n");
}

}  // namespace scantet
