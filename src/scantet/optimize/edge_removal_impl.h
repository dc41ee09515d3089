// Private: other tets in place of those around an edge.
#pragma once

#include <array>
#include <vector>

#include "scantet/optimize/change_impl.h"
#include "scantet/optimize/surface_guard_impl.h"

namespace scantet::optimize {

enum class EdgeKind { inner, boundary };

/// Looks for edges that can be done without; keeps its buffers.
class EdgeRemoval {
 public:
  EdgeRemoval(const TetComplex& complex, SurfaceGuard& guard)
      : complex_(complex), guard_(guard), bound_(complex.judge().bound()) {}

  /// Puts into `best` the best tets without the edge ab that fill the place of those around it, if none of them is as
  /// sharp as best.sharpest. Removing a boundary edge flips it: the edge between the vertices across from it takes its
  /// place. Edges of the other kind are passed over, as are those with more than kMostTets tets.
  void try_edge(VertexId a, VertexId b, EdgeKind kind, Change& best);

 private:
  static constexpr std::size_t kMostTets = 8;

  /// A tet (a, b, from, to), positively oriented.
  struct RingTet {
    TetId tet;
    VertexId from;
    VertexId to;
    Region region;
  };
  /// The tets of one region, from `begin` on in the ring; with a and b they span the polygon from ring_[begin].from to
  /// ring_[end - 1].to.
  struct Sector {
    std::size_t begin;
    std::size_t end;
  };

  bool find_ring(VertexId a, VertexId b);
  bool is_closed() const { return ring_.back().to == ring_.front().from; }
  void find_sectors();
  double triangulate(VertexId a, VertexId b, const Sector& sector, double too_sharp);
  void collect(VertexId a, VertexId b, std::size_t i, std::size_t j, Region region);
  double rate_flip(VertexId a, VertexId b, VertexId u, VertexId w);
  bool may_lose(VertexId v);

  const TetComplex& complex_;
  SurfaceGuard& guard_;
  double bound_;
  std::vector<RingTet> ring_;  // the tets at the edge, counterclockwise as seen from b
  std::vector<Sector> sectors_;
  std::vector<VertexId> polygon_;
  /// For the part of the polygon from i to j: the sharpest tet of its best triangulation, and the corner of the
  /// triangle at the edge ij.
  std::array<std::array<double, kMostTets + 1>, kMostTets + 1> sharpest_{};
  std::array<std::array<std::size_t, kMostTets + 1>, kMostTets + 1> corner_{};
  std::vector<NewTet> added_;
  Fan fan_;
};

}  // namespace scantet::optimize
