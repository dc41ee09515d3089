// Sizes that put several tets across thin parts.
#pragma once

#include <set>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/domain/cone_tree.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

/// What is asked of thin parts, and on which scale they are looked at.
struct LayerSettings {
  int layers = 2;            ///< tets across, at least 2
  std::set<Region> regions;  ///< whose parts
  double spacing_mm = 0;     ///< between the points of the boundary that are looked at
  double thinnest_mm = 0;    ///< parts thinner than this are left as they are: tips of wedges, whose sides meet
};

/// Sizes in the thin parts of regions, which the field exceeds there, about a spacing apart; none if progress was
/// cancelled, or no part is as thin as that.
///
/// The thickness at a point of a region's boundary is the distance to where the region ends along the inward normal, if
/// the boundary there faces back, to within 45 degrees. A tet of circumradius r has no edge longer than 2·r, so n edges
/// in a row reach no farther than 2·n·r: circumradii below thickness / (2·(layers - 1)) leave no way of fewer than
/// `layers` edges from side to side. The sizes are 0.8 of that, for what normals and places are off.
/// The same for any number of threads.
std::vector<Cone> layer_sizes(const Domain& domain, const LayerSettings& settings, const SizingField& field,
                              const Progress& progress);

}  // namespace scantet
