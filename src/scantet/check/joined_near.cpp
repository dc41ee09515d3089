#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "scantet/base/parallel.h"
#include "scantet/base/union_find.h"
#include "scantet/check/facet_tree_impl.h"
#include "scantet/check/grid_nodes_impl.h"
#include "scantet/check/joined_near_impl.h"

namespace scantet::auditing {
namespace {

constexpr double kNear = 0.5;  // voxels
constexpr std::array kAlong{0.0, 0.25, 0.5, 0.75, 1.0};

using Corners = std::array<Vec, 4>;

class NearTets {
 public:
  NearTets(const TetMesh& mesh, const Frame& frame, std::span<const NarrowWay> ways) : mesh_(mesh), frame_(frame) {
    for (const NarrowWay& way : ways) {
      for (const double along : kAlong) {
        places_.push_back(frame.to_index(lerp(way.segment.source, way.segment.target, along)));
        box_.extend(places_.back());
      }
    }
    box_ = box_.grown(kNear);
    find_tets(ways.front().region);
    join();
  }

  /// The set of joined tets that one with the point is in.
  std::optional<std::uint32_t> set_at(const Point& p) {
    const Vec at = frame_.to_index(p);
    for (std::uint32_t n = 0; n < tets_.size(); ++n) {
      if (holds(corners_of(tets_[n]), at)) return sets_.find(n);
    }
    return std::nullopt;
  }

 private:
  Corners corners_of(std::uint32_t tet) const {
    Corners corners;
    for (std::size_t n = 0; n < 4; ++n) corners[n] = frame_.to_index(mesh_.vertices[mesh_.tets[tet][n]]);
    return corners;
  }

  static bool holds(const Corners& corners, const Vec& p) {
    const double volume = volume_of(corners);
    for (std::size_t n = 0; n < 4; ++n) {
      Corners part = corners;
      part[n] = p;
      if (volume_of(part) * volume < -kNodeRounding * volume * volume) return false;
    }
    return true;
  }
  static double volume_of(const Corners& c) { return dot(c[1] - c[0], cross(c[2] - c[0], c[3] - c[0])); }

  void find_tets(Region region) {
    constexpr std::size_t kGrain = 4096;
    const auto look = [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& out) {
      for (std::size_t t = begin; t < end; ++t) {
        if (mesh_.tet_regions[t] != region) continue;
        Box box;
        for (const Vec& corner : corners_of(static_cast<std::uint32_t>(t))) box.extend(corner);
        if (box.meets(box_)) out.push_back(static_cast<std::uint32_t>(t));
      }
    };
    tets_ = parallel_collect<std::uint32_t>(mesh_.tets.size(), kGrain, look);
  }

  void join() {
    sets_ = UnionFind(tets_.size());
    std::map<Triangle, std::uint32_t> first;  // with the face
    for (std::uint32_t n = 0; n < tets_.size(); ++n) {
      for (std::size_t left_out = 0; left_out < 4; ++left_out) {
        Triangle face{};
        for (std::size_t i = 0; i < 3; ++i) face[i] = mesh_.tets[tets_[n]][(left_out + 1 + i) % 4];
        std::sort(face.begin(), face.end());
        const auto [known, is_new] = first.emplace(face, n);
        if (!is_new && is_near(face)) sets_.unite(n, known->second);
      }
    }
  }

  bool is_near(const Triangle& face) const {
    FacetCorners corners;
    for (std::size_t n = 0; n < 3; ++n) corners[n] = frame_.to_index(mesh_.vertices[face[n]]);
    return std::any_of(places_.begin(), places_.end(),
                       [&](const Vec& p) { return distance(p, nearest_on_triangle(p, corners)) <= kNear; });
  }

  const TetMesh& mesh_;
  const Frame& frame_;
  std::vector<Vec> places_;  // on the ways
  Box box_;                  // around what is near them
  std::vector<std::uint32_t> tets_;
  UnionFind sets_;
};

}  // namespace

bool are_joined_near(const TetMesh& mesh, const Frame& frame, std::span<const NarrowWay> ways,
                     std::span<const Point> points) {
  NearTets tets(mesh, frame, ways);
  std::optional<std::uint32_t> all;
  for (const Point& p : points) {
    const std::optional<std::uint32_t> set = tets.set_at(p);
    if (!set || (all && *all != *set)) return false;
    all = set;
  }
  return true;
}

}  // namespace scantet::auditing
