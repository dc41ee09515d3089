// The collar of a mesh's boundary: heights are found by trying, and then proved to do.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/verify/left_out.h"
#include "scantet/verify/prism.h"
#include "scantet/verify/shell.h"

namespace scantet::verify {

/// Why a facet is not certified, as bits.
enum CollarFault : std::uint8_t {
  kNoFault = 0,
  kValue = 1,    ///< the level is not shown to lie between the two ends of the fibres
  kSlope = 2,    ///< the field is not shown to grow along the fibres
  kFold = 4,     ///< fibres may cross within the facet
  kCrowded = 8,  ///< the collar may meet that of another facet
  kVertex = 16,  ///< the facets around a corner are not shown to go round it once
};

/// A collar and what of it is proved.
struct Collar {
  std::vector<Vec> directions;       ///< one a vertex of the shell: of its fibre, index coordinates, about 1 mm long
  std::vector<double> heights;       ///< mm, nearly: its fibre is from -height·direction to height·direction
  std::vector<std::uint8_t> faults;  ///< one a facet: CollarFault; 0: certified
  std::vector<double> sampled_mm;    ///< one a facet: how far the level set is along fibres, at some points; no proof
  std::vector<double> bound_mm;      ///< one a facet: how far it is at most along fibres; proved where certified
};

/// What a collar is of.
struct CollarInput {
  const TetMesh& mesh;
  const Shell& shell;  ///< closed
  const VoxelNodes& nodes;
  const IndexMap& map;
  std::vector<IntervalVec> places;  ///< of the shell's vertices, index coordinates
  const NodeSides& sides;           ///< of nodes, if parts of the field were left out
};

CollarInput collar_input(const TetMesh& mesh, const Shell& shell, const VoxelNodes& nodes, const IndexMap& map,
                         const NodeSides& sides);

/// Corners of a facet in the order in which a collar wants them.
Triangle inward(const CollarInput& input, std::size_t facet);

/// The facet's collar.
Prism prism_of(const CollarInput& input, const Collar& collar, std::size_t facet);

/// The collar that was best after so many rounds.
Collar find_collar(const CollarInput& input, int rounds, Progress& progress);

/// Whether one of these places (world), or one up to 1e-5 mm beside it, may be in the collar.
bool may_hold(const CollarInput& input, const Collar& collar, const std::vector<Point>& places);

/// Sets bound_mm of the certified facets, as tight as a few tries make it.
void bound_distances(const CollarInput& input, Collar& collar, Progress& progress);

}  // namespace scantet::verify
