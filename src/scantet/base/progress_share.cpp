#include "scantet/base/progress_share.h"

#include <algorithm>
#include <iterator>

namespace scantet {
namespace {

struct StageShare {
  const char* stage;
  double begin;
  double end;
};

constexpr StageShare kStages[] = {{"read", 0, 0.1},        {"sample", 0.1, 0.2},  {"refine", 0.2, 0.6},
                                  {"optimize", 0.6, 0.85}, {"audit", 0.85, 0.95}, {"write", 0.95, 1}};

}  // namespace

double progress_share(const ProgressState& state) {
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

}  // namespace scantet
