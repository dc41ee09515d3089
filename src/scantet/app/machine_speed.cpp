// The best of a few runs, on one thread, by the clock of the process: what else the machine does counts little.
#include "scantet/app/machine_speed.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <limits>

#include "scantet/app/meshing.h"
#include "scantet/base/quantity.h"
#include "scantet/domain/analytic.h"

namespace scantet {

double trial_seconds() {
  if (const char* known = std::getenv("SCANTET_TRIAL")) return read_duration("SCANTET_TRIAL", known);
  constexpr int kRuns = 3;
  constexpr double kRadius_mm = 10;
  constexpr double kSize_mm = 0.7;
  const auto ball = make_sphere({}, kRadius_mm);
  const auto size = std::make_shared<UniformSize>(kSize_mm);
  MesherOptions mesher;
  mesher.threads = 1;
  double best_s = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) {
    Progress progress;
    const std::clock_t start = std::clock();
    mesh_and_optimize(*ball, size, mesher, {}, progress);
    best_s = std::min(best_s, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best_s;
}

}  // namespace scantet
