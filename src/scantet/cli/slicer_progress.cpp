#include "scantet/cli/slicer_progress.h"

#include <utility>

#include "scantet/base/options.h"
#include "scantet/base/progress_share.h"
#include "scantet/cli/interrupt.h"
#include "scantet/cli/print.h"

namespace scantet {
namespace {

constexpr double kEvery_s = 0.1;
constexpr double kLeastStep = 0.01;

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
  const double share = progress_share(state);
  const double now_s = passed_s();
  if (share < printed_ + kLeastStep || now_s < printed_s_ + kEvery_s) return;
  printed_ = share;
  printed_s_ = now_s;
  print("<filter-progress>" + number_text(share, 3) + "</filter-progress>\n");
}

}  // namespace scantet
