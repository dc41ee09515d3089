// Two meshes of one domain, of which the better one is kept but for some places.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet {

/// A ball, world mm.
struct GraftSite {
  Point center;
  double radius_mm = 0;
};

/// The kept mesh with tets of the fresh one in place of its own that touch a site by a vertex, and of those around them
/// up to faces that both meshes have, between the same regions. Vertices of the kept mesh come first, in their order.
/// missing_euler: if given, the kept tets stay wherever a region would have another Euler number without them, but for
/// places that bring the sum of these numbers nearer to that many more.
/// Both meshes: with their boundaries and strata. Nothing if there are no such faces around, if a fourth of the tets or
/// more would change, or if one of the meshes has sharp curves. Guarantee: the tets on either side of each face
/// where the two meet lie on different sides of it.
std::optional<TetMesh> graft(const TetMesh& kept, const TetMesh& fresh, const std::vector<GraftSite>& sites,
                             std::optional<std::int64_t> missing_euler = std::nullopt);

}  // namespace scantet
