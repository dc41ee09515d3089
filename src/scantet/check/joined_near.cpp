#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "scantet/check/broken_ways_impl.h"
#include "scantet/check/joined_near_impl.h"

namespace scantet::auditing {
namespace {

constexpr int kSteps = 8;      // of a voxel
constexpr double kNear = 0.5;  // voxels

class FineLines {
 public:
  FineLines(const TetMesh& mesh, const Frame& frame, std::span<const NarrowWay> ways) : mesh_(mesh), frame_(frame) {
    for (const NarrowWay& way : ways) {
      ways_.push_back({to_fine(way.segment.source), to_fine(way.segment.target)});
      for (const Point& p : {ways_.back().source, ways_.back().target}) box_.extend(p);
    }
    box_ = box_.grown(kNear * kSteps);
  }

  /// Takes the steps that the boundary of the region crosses.
  void block(const FaceMatch& match, Region region) {
    constexpr std::size_t kGrain = 4096;
    const auto look = [&](std::size_t begin, std::size_t end, std::vector<Crossing>& out) {
      for (std::size_t f = begin; f < end; ++f) {
        if (!is_of(match.boundary[f], region)) continue;
        const FineFacet facet = facet_of(match.boundary[f]);
        if (facet.box.meets(box_)) add_crossings(facet.corners, box_, out);
      }
    };
    for (const Crossing& crossing : parallel_collect<Crossing>(match.boundary.size(), kGrain, look)) {
      blocked_.insert(crossing.edge);
    }
  }

  /// Whether steps near the ways lead from the first point to all others.
  bool join(std::span<const Point> points) const {
    std::set<GridCell> seen{node_at(points.front())};
    std::vector<GridCell> front(seen.begin(), seen.end());
    while (!front.empty()) {
      const GridCell node = front.back();
      front.pop_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int step : {-1, 1}) {
          GridCell edge = node;
          edge.center[axis] += step;
          GridCell next = edge;
          next.center[axis] += step;
          if (blocked_.contains(edge) || !is_near(next) || !seen.insert(next).second) continue;
          front.push_back(next);
        }
      }
    }
    return std::all_of(points.begin(), points.end(), [&](const Point& p) { return seen.contains(node_at(p)); });
  }

 private:
  struct FineFacet {
    std::array<Vec, 3> corners;
    Box box;
  };

  bool is_of(const BoundaryFace& face, Region region) const {
    const Region behind = mesh_.tet_regions[face.behind];
    const Region front = face.front == kNone ? kOutside : mesh_.tet_regions[face.front];
    return behind == region || front == region;
  }

  FineFacet facet_of(const BoundaryFace& face) const {
    FineFacet facet;
    for (std::size_t n = 0; n < 3; ++n) {
      facet.corners[n] = to_fine(mesh_.vertices[face.vertices[n]]);
      facet.box.extend(facet.corners[n]);
    }
    return facet;
  }

  Vec to_fine(const Point& p) const { return double(kSteps) * frame_.to_index(p); }

  GridCell node_at(const Point& p) const {
    const Vec at = to_fine(p);
    GridCell node;
    for (int axis = 0; axis < 3; ++axis) {
      node.center[static_cast<std::size_t>(axis)] = 2 * static_cast<int>(std::lround(at[axis]));
    }
    return node;
  }

  bool is_near(const GridCell& node) const {
    const Vec p{double(node.first(0)), double(node.first(1)), double(node.first(2))};
    return std::any_of(ways_.begin(), ways_.end(), [&](const Segment& way) {
      const Vec along = way.target - way.source;
      const double length2 = squared_length(along);
      const double t = length2 > 0 ? std::clamp(dot(p - way.source, along) / length2, 0.0, 1.0) : 0;
      return distance(p, lerp(way.source, way.target, t)) <= kNear * kSteps;
    });
  }

  const TetMesh& mesh_;
  const Frame& frame_;
  std::vector<Segment> ways_;  // in steps
  Box box_;                    // around what is near them
  std::set<GridCell> blocked_;
};

}  // namespace

bool are_joined_near(const TetMesh& mesh, const FaceMatch& match, const Frame& frame, std::span<const NarrowWay> ways,
                     std::span<const Point> points) {
  FineLines lines(mesh, frame, ways);
  lines.block(match, ways.front().region);
  return lines.join(points);
}

}  // namespace scantet::auditing
