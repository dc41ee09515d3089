// Private: finds channels that the sample missed.
#pragma once

#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "scantet/delaunay/inserter_impl.h"
#include "scantet/surface/pieces_impl.h"

namespace scantet::engine {

/// Looks for the ways by which pieces are connected that are one in the domain but not in the mesh. The search is on a
/// grid and the places of the domain's size hints. From one piece it goes step by step, where no step crosses ∂O, until
/// it meets another piece of its side. Where nothing is found the steps are halved.
class ChannelSearch {
 public:
  /// pieces: as they are now. hints: the places of the domain's size hints.
  ChannelSearch(const Domain& domain, RestrictedTriangulation& triangulation, Pieces& pieces,
                const std::vector<Point>& hints);

  /// Starts from the piece that has these facets. Returns boundary points around the channel where the mesh has none,
  /// the closer the narrower the channel is; empty if even the last step is too long for it. first_mm, last_mm: steps;
  /// > 0.
  std::vector<SamplePoint> points(const std::vector<FacetCode>& facets, double first_mm, double last_mm);

 private:
  using Key = std::array<std::int64_t, 3>;  // of a cell of the grid, whose middle is a node
  struct HashOfKey {
    std::size_t operator()(const Key& key) const;
  };
  struct Node {
    Point place;
    std::uint32_t from;  ///< the node that it was reached from; kNone: from the piece
    CellId cell;         ///< contains it
  };
  bool find_way(const std::vector<FacetCode>& facets);
  bool reach_around(const Point& from, std::uint32_t parent, CellId near);
  bool reach(const Point& from, std::uint32_t parent, CellId near, std::vector<Point>& places);
  void sample_around(const Node& node);
  Key key_of(const Point& p) const;

  const Domain& domain_;
  Triangulation& t_;
  Inserter inserter_;
  Pieces& pieces_;
  const std::vector<Point>& hints_;

  std::uint32_t piece_ = kNone;  // where the search starts
  Region side_ = kOutside;       // of that piece
  double step_mm_ = 0;
  std::vector<Node> nodes_;                                        // reached, in this order
  std::unordered_map<Key, std::vector<Point>, HashOfKey> places_;  // to be reached
  std::unordered_set<Key, HashOfKey> known_;                       // cells whose middle has been put into places_
  std::vector<SamplePoint> points_;
  Crossings crossings_;
};

}  // namespace scantet::engine
