#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "scantet/check/broken_ways_impl.h"
#include "scantet/check/joined_near_impl.h"

namespace scantet::auditing {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr int kSteps = 8;        // of a voxel
constexpr double kNear = 0.5;    // voxels
constexpr double kTouch = 1e-6;  // steps, from what lies on the boundary

class FineLines {
 public:
  FineLines(const TetMesh& mesh, const Frame& frame, std::span<const NarrowWay> ways) : mesh_(mesh), frame_(frame) {
    for (const NarrowWay& way : ways) {
      ways_.push_back({to_fine(way.segment.source), to_fine(way.segment.target)});
      for (const Point& p : {ways_.back().source, ways_.back().target}) box_.extend(p);
    }
    box_ = box_.grown(kNear * kSteps);
  }

  /// Takes the steps that the boundary of the region crosses. boxes: around its faces, voxels.
  void block(const FaceMatch& match, const std::vector<Box>& boxes, Region region) {
    const Box near{(1.0 / kSteps) * box_.min, (1.0 / kSteps) * box_.max};
    const auto look = [&](std::size_t begin, std::size_t end, std::vector<Crossing>& out) {
      for (std::size_t f = begin; f < end; ++f) {
        const BoundaryFace& face = match.boundary[f];
        if (boxes[f].meets(near) && is_of(face, region)) add_crossings(corners_of(face), box_, out);
      }
    };
    for (const Crossing& crossing : parallel_collect<Crossing>(match.boundary.size(), kGrain, look)) {
      blocked_.insert(crossing.edge);
      if (std::abs(crossing.at - std::round(crossing.at)) < kTouch) on_boundary_.insert(node_of(crossing));
    }
  }

  /// Whether steps near the ways lead from the first point to all others. From one on the boundary they may lead along
  /// the other side of it: then they tell nothing.
  bool join(std::span<const Point> points) const {
    const auto is_on_boundary = [&](const Point& p) { return on_boundary_.contains(node_at(p)); };
    if (std::any_of(points.begin(), points.end(), is_on_boundary)) return false;
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
  bool is_of(const BoundaryFace& face, Region region) const {
    const Region behind = mesh_.tet_regions[face.behind];
    const Region front = face.front == kNone ? kOutside : mesh_.tet_regions[face.front];
    return behind == region || front == region;
  }

  std::array<Vec, 3> corners_of(const BoundaryFace& face) const {
    const auto corner = [&](std::size_t n) { return to_fine(mesh_.vertices[face.vertices[n]]); };
    return {corner(0), corner(1), corner(2)};
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

  /// The nearest to it.
  static GridCell node_of(const Crossing& crossing) {
    GridCell node = crossing.edge;
    std::size_t axis = 0;
    while (!node.is_wide(axis)) ++axis;
    node.center[axis] = 2 * static_cast<int>(std::lround(crossing.at));
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
  std::set<GridCell> on_boundary_;
};

}  // namespace

LinesBeside::LinesBeside(const TetMesh& mesh, const FaceMatch& match, const Frame& frame)
    : mesh_(mesh), match_(match), frame_(frame), boxes_(match.boundary.size()) {
  parallel_for(boxes_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      for (const VertexId v : match.boundary[f].vertices) boxes_[f].extend(frame.to_index(mesh.vertices[v]));
    }
  });
}

bool LinesBeside::join(std::span<const NarrowWay> ways, std::span<const Point> points) const {
  FineLines lines(mesh_, frame_, ways);
  lines.block(match_, boxes_, ways.front().region);
  return lines.join(points);
}

}  // namespace scantet::auditing
