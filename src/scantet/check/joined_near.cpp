#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "scantet/base/neighbors.h"
#include "scantet/check/broken_ways_impl.h"
#include "scantet/check/held_edges_impl.h"
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

  /// Finds where steps begin from these points: at one that is on the boundary, at all of the 26 nodes around it that
  /// are in the region.
  void find_starts(std::span<const Point> points, Region region) {
    Box box;
    for (const Point& p : points) {
      const GridCell node = node_at(p);
      std::vector<GridCell>& starts = starts_[node];
      starts.clear();
      if (!on_boundary_.contains(node)) {
        starts.push_back(node);
        continue;
      }
      for (const NeighborOffset& offset : kNeighborhood) {
        GridCell around = node;
        for (std::size_t axis = 0; axis < 3; ++axis) around.center[axis] += 2 * offset[axis];
        if (on_boundary_.contains(around) || !is_near(around)) continue;
        starts.push_back(around);
        box.extend(around.middle());
      }
    }
    const std::vector<std::uint32_t> tets = tets_near(box, region);
    for (auto& [node, starts] : starts_) {
      if (!on_boundary_.contains(node)) continue;
      std::erase_if(starts, [&](const GridCell& start) {
        const bool is_in_any = std::any_of(
            tets.begin(), tets.end(), [&](std::uint32_t tet) { return is_in_tet(corners_of(tet), start.middle()); });
        return is_in_any == (region == kOutside);
      });
    }
  }

  /// Whether steps near the ways lead from the first point to all others.
  bool join(std::span<const Point> points) const {
    const std::vector<GridCell>& first = starts_.at(node_at(points.front()));
    std::set<GridCell> seen(first.begin(), first.end());
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
          if (blocked_.contains(edge) || on_boundary_.contains(next) || !is_near(next)) continue;
          if (!seen.insert(next).second) continue;
          front.push_back(next);
        }
      }
    }
    return std::all_of(points.begin(), points.end(), [&](const Point& p) {
      const std::vector<GridCell>& starts = starts_.at(node_at(p));
      return std::any_of(starts.begin(), starts.end(), [&](const GridCell& start) { return seen.contains(start); });
    });
  }

 private:
  bool is_of(const BoundaryFace& face, Region region) const {
    const Region behind = mesh_.tet_regions[face.behind];
    const Region front = face.front == kNone ? kOutside : mesh_.tet_regions[face.front];
    return behind == region || front == region;
  }

  /// Of the region that meet a box, in steps; of kOutside those of all regions.
  std::vector<std::uint32_t> tets_near(const Box& box, Region region) const {
    if (box.empty()) return {};
    return parallel_collect<std::uint32_t>(mesh_.tets.size(), kGrain,
                                           [&](std::size_t begin, std::size_t end, auto& out) {
                                             for (std::size_t t = begin; t < end; ++t) {
                                               if (region != kOutside && mesh_.tet_regions[t] != region) continue;
                                               Box around;
                                               for (const Vec& corner : corners_of(static_cast<std::uint32_t>(t)))
                                                 around.extend(corner);
                                               if (around.meets(box)) out.push_back(static_cast<std::uint32_t>(t));
                                             }
                                           });
  }

  std::array<Vec, 4> corners_of(std::uint32_t tet) const {
    std::array<Vec, 4> corners;
    for (std::size_t n = 0; n < 4; ++n) corners[n] = to_fine(mesh_.vertices[mesh_.tets[tet][n]]);
    return corners;
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
    node.center[crossing.edge.axis()] = 2 * static_cast<int>(std::lround(crossing.at));
    return node;
  }

  bool is_near(const GridCell& node) const {
    const Vec p = node.middle();
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
  std::map<GridCell, std::vector<GridCell>> starts_;  // from nodes that are asked for
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
  lines.find_starts(points, ways.front().region);
  return lines.join(points);
}

}  // namespace scantet::auditing
