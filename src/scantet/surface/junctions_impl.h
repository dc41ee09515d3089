// Private: what meets at the vertices on curves and at corners.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

/// A point on a curve or at a corner.
struct Junction {
  std::vector<Region> regions;  ///< that meet there, ascending
  bool is_merged = false;       ///< it stands for points of several curves, or for several corners
};

/// A piece of a curve between two of them that are next to each other along it.
struct CurvePiece {
  std::array<PointId, 2> ends;
  std::vector<Region> regions;  ///< around the curve, ascending
};

/// Those of a triangulation: they are its points with weights, which are the first to be inserted.
class Junctions {
 public:
  Junctions() = default;
  /// In the order in which they are inserted.
  explicit Junctions(std::vector<Junction> junctions, std::vector<CurvePiece> pieces = {})
      : junctions_(std::move(junctions)), pieces_(std::move(pieces)) {}

  bool empty() const { return junctions_.empty(); }
  const std::vector<CurvePiece>& pieces() const { return pieces_; }
  /// Whether two regions meet at a vertex on a curve or at a corner; true where that is not known.
  bool meet_at(PointId v, const std::array<Region, 2>& regions) const {
    const Junction* junction = at(v);
    return junction == nullptr || (has(*junction, regions[0]) && has(*junction, regions[1]));
  }
  /// Whether a vertex stands for several points of curves.
  bool is_merged(PointId v) const { return at(v) != nullptr && at(v)->is_merged; }

 private:
  const Junction* at(PointId v) const {  // v wraps around below the corners
    return v - Triangulation::kCorners < junctions_.size() ? &junctions_[v - Triangulation::kCorners] : nullptr;
  }
  static bool has(const Junction& junction, Region region) {
    return std::binary_search(junction.regions.begin(), junction.regions.end(), region);
  }

  std::vector<Junction> junctions_;
  std::vector<CurvePiece> pieces_;
};

}  // namespace scantet::engine
