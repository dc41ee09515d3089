// Parts of a domain's boundary that have names of their own.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "scantet/base/tet_mesh.h"
#include "scantet/domain/domain.h"

namespace scantet {

/// What a Domain is beside, if the boundary between two of its regions consists of pieces that meshes are to tell
/// apart, as the flat ends of a cut object.
class PatchPieces {
 public:
  virtual ~PatchPieces() = default;

  /// The piece that a boundary facet lies on, counted from 1; 0 if it is none of them.
  virtual std::size_t piece_of(const std::array<Point, 3>& facet) const = 0;
  /// Of pieces from 1 on. Not empty.
  virtual std::string name_of_piece(std::size_t piece) const = 0;
};

/// Parts the patches of a mesh, which has its strata, by the pieces of the domain's boundary. A piece has a patch for
/// each region behind it; if there are several, the region's name follows the piece's. Vertices of curves stay where
/// they are. Does nothing if the domain has no pieces.
void part_patches(TetMesh& mesh, const Domain& domain);

}  // namespace scantet
