// A counting sort.
#include "scantet/quality/tet_stars.h"

#include <algorithm>

#include "scantet/base/parallel.h"

namespace scantet {
namespace {

/// Calls visit(vertex, tet) for all but the largest vertex of each tet, on several threads. One that has a vertex twice
/// may come with it twice.
template <class Visit>
void each_start(const TetMesh& mesh, const Visit& visit) {
  constexpr std::size_t kTets = 16384;
  parallel_for(mesh.tets.size(), kTets, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Tet& tet = mesh.tets[i];
      const VertexId largest = std::max({tet[0], tet[1], tet[2], tet[3]});
      for (const VertexId v : tet) {
        if (v != largest) visit(v, static_cast<std::uint32_t>(i));
      }
    }
  });
}

}  // namespace

TetStars::TetStars(const TetMesh& mesh) : of_vertex_(mesh.vertices.size()) {
  each_start(mesh, [&](VertexId v, std::uint32_t) { of_vertex_.count(v); });
  tets_.resize(of_vertex_.close());
  each_start(mesh, [&](VertexId v, std::uint32_t tet) { tets_[of_vertex_.place(v)] = tet; });
}

}  // namespace scantet
