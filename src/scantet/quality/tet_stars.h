// The tets at each vertex of a mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scantet/base/parallel_buckets.h"
#include "scantet/base/tet_mesh.h"

namespace scantet {

/// The tets by their vertices, each at all but its largest: enough to find every edge and face at its smallest vertex.
/// Takes 12 bytes per tet. All vertex ids must be below vertices.size(), and there may be up to 2^30 tets.
class TetStars {
 public:
  /// On several threads.
  explicit TetStars(const TetMesh& mesh);

  /// The tets that have v and a vertex of larger id, in any order.
  std::span<const std::uint32_t> of(std::size_t v) const {
    return {tets_.data() + of_vertex_.begin(v), tets_.data() + of_vertex_.end(v)};
  }

 private:
  ParallelBuckets of_vertex_;
  std::vector<std::uint32_t> tets_;
};

}  // namespace scantet
