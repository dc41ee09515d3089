#include "scantet/size_options/size_notes.h"

#include <algorithm>

#include "scantet/base/options.h"

namespace scantet {

std::string note_on_default(const std::string& size, const std::string& reason) {
  return "no --size given: size " + size + " mm, " + reason;
}

std::string note_on_grid(const SizeGrid& grid) {
  return "sizes from " + number_text(grid.min_size(), 3) + " mm on, made 1-Lipschitz, on a grid of " +
         number_text(grid.step_mm(), 3) + " mm: at most " + number_text(grid.error_mm(), 3) + " mm off";
}

std::string note_on_auto(const BoundaryCones& cones, const AutoSizes& how) {
  const auto [smallest, largest] = std::minmax_element(
      cones.sizes.begin(), cones.sizes.end(), [](const Cone& a, const Cone& b) { return a.height_mm < b.height_mm; });
  return "auto: sizes from " + number_text(smallest->height_mm, 3) + " to " + number_text(largest->height_mm, 3) +
         " mm on the boundary, " + number_text(how.share) + " x its " +
         (how.features.lipschitz_k ? "Lipschitz radius" : "distance to the medial axis") + ", at least " +
         number_text(how.least_mm, 3) + " mm, from a sample " + number_text(cones.spacing_mm, 3) +
         " mm apart: narrower places may be passed over";
}

std::string note_on_layers(const LayerSettings& settings, const std::vector<Cone>& sizes) {
  const std::string asked = "--layers " + std::to_string(settings.layers);
  if (sizes.empty()) return asked + ": no part is so thin that its size must be less for it";
  double least_mm = sizes.front().height_mm;
  for (const Cone& cone : sizes) least_mm = std::min(least_mm, cone.height_mm);
  return asked + ": sizes down to " + number_text(least_mm, 3) + " mm in thin parts; parts thinner than " +
         number_text(settings.thinnest_mm, 3) + " mm are left as they are";
}

}  // namespace scantet
