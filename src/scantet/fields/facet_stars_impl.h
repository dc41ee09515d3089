// The facets of some tets of a mesh, each with the tets on its sides. Private to fields/.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/base/parallel_buckets.h"
#include "scantet/base/tet_mesh.h"

namespace scantet {

/// A side of a facet: of which tet, which facet of it, and whether its corners turn the other way as seen from there.
struct FacetSide {
  std::uint32_t tet = 0;
  std::uint32_t facet = 0;  // 0 to 3: the one that faces this corner
  bool is_turned = false;
};

/// Facets by their smallest vertices. There may be up to 2^30 tets.
class FacetStars {
 public:
  /// On several threads. is_chosen: one per tet; facets of others are left out.
  FacetStars(const TetMesh& mesh, const std::vector<std::uint8_t>& is_chosen);

  /// A facet and its one or two sides.
  struct Facet {
    Triangle corners{};  // ascending; seen from outside of a tet they turn left if it is not turned
    std::uint32_t count = 0;
    std::array<FacetSide, 2> sides{};
  };

  /// The facets whose smallest vertex this is, in an order that depends on the mesh alone.
  void facets_of(std::size_t vertex, std::vector<Facet>& facets) const;

 private:
  const TetMesh* mesh_;
  ParallelBuckets of_vertex_;
  std::vector<std::uint32_t> sides_;  // four times the tet, plus the facet
};

}  // namespace scantet
