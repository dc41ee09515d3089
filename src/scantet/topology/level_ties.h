// What nodes at the level itself add to the Euler numbers of the parts above and below it.
#pragma once

#include <array>
#include <functional>

#include "scantet/base/progress.h"
#include "scantet/field/height_grid.h"

namespace scantet {

/// Takes eight times what is to be added to the Euler number of the part that `node`, which is not at the level, lies
/// in.
using TieSink = std::function<void(const std::array<int, 3>& node, int eighths)>;

/// Adds up, for the nodes at the level in the layers first ≤ k < last, and for the edges and faces between such nodes
/// that begin at them, by what the Euler number of a part differs from that of {h > 0} or {h < 0} (add_cell_shares()):
/// parts that meet in a face are one, the point or edge that is missing in a part is filled in, parts that touch at a
/// point are apart, and so are, along an edge, those above; those below are joined there. Exact, but where two parts
/// touch along a line in such a face.
void count_ties(const HeightGrid& heights, int first, int last, const Progress& progress, const TieSink& add);

}  // namespace scantet
