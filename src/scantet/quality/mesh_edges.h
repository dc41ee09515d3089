// Every edge of a mesh, once.
#pragma once

#include <functional>
#include <vector>

#include "scantet/base/parallel_buckets.h"
#include "scantet/base/tet_mesh.h"

namespace scantet {

/// The edges of all tets by their vertex of smaller id. Takes 24 bytes per tet. All vertex ids must be below
/// vertices.size().
class EdgeStars {
 public:
  /// On several threads.
  explicit EdgeStars(const TetMesh& mesh);

  /// Calls visit(v, neighbours) for each vertex v of [begin, end) in ascending order, with its neighbours of larger id,
  /// ascending: each edge of a tet comes up once. Vertices without such neighbours are left out. Any thread.
  void visit(std::size_t begin, std::size_t end,
             const std::function<void(VertexId, const std::vector<VertexId>&)>& visit) const;

 private:
  ParallelBuckets of_vertex_;
  std::vector<VertexId> larger_;  // the larger ends of all edges of all tets
};

}  // namespace scantet
