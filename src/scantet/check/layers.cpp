// A search along edges from each vertex of the boundary, breadth first, that goes on through inner vertices alone: a
// way along the boundary is found, shorter, from the vertex where it leaves that.
//
// Through a thick part a search would see all that is within so many edges, and find nothing. So it is told beforehand
// how far it is from each vertex, at the least, to boundary that may face back: normals are sorted by 26 directions,
// and for each of these one search counts the edges from all the boundary that faces away from it. Where too many are
// left, a search does not go on. What it finds is the same as without that.
#include "scantet/check/layers.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>

#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"

namespace scantet {
namespace {

constexpr double kOpposite = 0.7;  // cosine between the normal of one side and that back of the other
constexpr double kInward = 0.5;    // cosine between the way across and the inward normal
// A normal is within 27.6 degrees of one of the 26 directions, and what is opposite to it, within acos(kOpposite), has
// a cosine of less than -0.289 with that.
constexpr double kFacing = 0.28;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

using Steps = std::vector<std::uint8_t>;  // at least so many edges lie between each vertex and boundary that faces back
constexpr std::uint8_t kFar = std::numeric_limits<std::uint8_t>::max();

/// What a search writes on; kept for the next one.
struct Scratch {
  explicit Scratch(std::size_t vertices) : marks(vertices, kNone) {}
  std::vector<std::uint32_t> marks;  // of each vertex: the search that has seen it last
  std::vector<std::uint32_t> seen;
};

/// As many as there are searches at the same time.
class ScratchPool {
 public:
  explicit ScratchPool(std::size_t vertices) : vertices_(vertices) {}

  std::unique_ptr<Scratch> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return std::make_unique<Scratch>(vertices_);
    std::unique_ptr<Scratch> one = std::move(free_.back());
    free_.pop_back();
    return one;
  }
  void give_back(std::unique_ptr<Scratch> one) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(one));
  }

 private:
  std::size_t vertices_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Scratch>> free_;
};

/// A region of the mesh: its vertices by numbers of their own, its edges, and its outward normals where it ends.
class RegionEdges {
 public:
  RegionEdges(const TetMesh& mesh, Region region, int layers, double thinnest_mm)
      : mesh_(mesh), layers_(layers), thinnest_mm_(thinnest_mm) {
    number_vertices(region);
    for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
      const auto& [behind, front] = mesh.facet_regions[i];
      if (behind == region) add_normal(mesh.boundary_facets[i], 1);
      if (front == region) add_normal(mesh.boundary_facets[i], -1);
    }
    for (Vec& normal : normals_) {
      const double size = length(normal);
      if (size > 0) normal = (1 / size) * normal;
    }
    list_edges(region);
  }

  /// How many vertices its boundary has.
  std::size_t boundary_size() const { return boundary_.size(); }

  /// Vertices of the boundary from which the other side is nearer than so many layers, each with the fewest edges from
  /// there and the middle of the way; ascending.
  std::vector<ThinPlace> thin_places() const {
    constexpr std::size_t kPiece = 256;
    const std::vector<std::uint8_t> groups = group_normals();
    std::vector<Steps> steps(kNeighborDirections.size());
    parallel_for(steps.size(), 1, [&](std::size_t group, std::size_t) {
      if (std::find(groups.begin(), groups.end(), group) == groups.end()) return;
      steps[group] = steps_to_facing(kNeighborDirections[group]);
    });
    ScratchPool pool(vertices_.size());
    return parallel_collect<ThinPlace>(
        boundary_.size(), kPiece, [&](std::size_t begin, std::size_t end, std::vector<ThinPlace>& out) {
          std::unique_ptr<Scratch> scratch = pool.take();
          for (std::size_t n = begin; n < end; ++n) {
            const ThinPlace place = across(static_cast<std::uint32_t>(n), steps[groups[n]], *scratch);
            if (place.layers < layers_) out.push_back(place);
          }
          pool.give_back(std::move(scratch));
        });
  }

 private:
  /// Numbers the vertices in the order of the mesh's.
  void number_vertices(Region region) {
    number_.assign(mesh_.vertices.size(), kNone);
    std::vector<std::uint8_t> on_boundary(mesh_.vertices.size(), 0);
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      if (mesh_.tet_regions[t] != region) continue;
      for (const VertexId v : mesh_.tets[t]) number_[v] = 0;
    }
    for (std::size_t i = 0; i < mesh_.boundary_facets.size(); ++i) {
      const auto& [behind, front] = mesh_.facet_regions[i];
      if (behind != region && front != region) continue;
      for (const VertexId v : mesh_.boundary_facets[i]) number_[v] = on_boundary[v] = 1;
    }
    for (VertexId v = 0; v < number_.size(); ++v) {
      if (number_[v] == kNone) continue;
      number_[v] = static_cast<std::uint32_t>(vertices_.size());
      side_.push_back(on_boundary[v] != 0 ? static_cast<std::uint32_t>(boundary_.size()) : kNone);
      if (on_boundary[v] != 0) boundary_.push_back(number_[v]);
      vertices_.push_back(v);
    }
    normals_.resize(boundary_.size());
  }

  void add_normal(const Triangle& facet, double sign) {
    const Point& a = mesh_.vertices[facet[0]];
    const Vec normal = sign * cross(mesh_.vertices[facet[1]] - a, mesh_.vertices[facet[2]] - a);
    for (const VertexId v : facet) {
      Vec& sum = normals_[side_[number_[v]]];
      sum = sum + normal;
    }
  }

  void list_edges(Region region) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      if (mesh_.tet_regions[t] != region) continue;
      for (const VertexId a : mesh_.tets[t]) {
        for (const VertexId b : mesh_.tets[t]) {
          if (a != b) edges.emplace_back(number_[a], number_[b]);
        }
      }
    }
    parallel_sort(edges, std::less<>());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    first_.assign(vertices_.size() + 1, 0);
    for (const auto& [a, b] : edges) {
      ++first_[a + 1];
      ends_.push_back(b);
    }
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  }

  /// Of each vertex of the boundary the direction that its normal is nearest to.
  std::vector<std::uint8_t> group_normals() const {
    std::vector<std::uint8_t> groups;
    groups.reserve(normals_.size());
    for (const Vec& normal : normals_) {
      const auto along = [&](const Vec& direction) { return dot(normal, direction) / length(direction); };
      std::size_t nearest = 0;
      for (std::size_t n = 1; n < kNeighborDirections.size(); ++n) {
        if (along(kNeighborDirections[n]) > along(kNeighborDirections[nearest])) nearest = n;
      }
      groups.push_back(static_cast<std::uint8_t>(nearest));
    }
    return groups;
  }

  /// Of each vertex the fewest edges, through inner vertices, to boundary that may be opposite to what faces in the
  /// direction, or fewer; 0 on that alone.
  Steps steps_to_facing(const Vec& direction) const {
    Steps steps(vertices_.size(), kFar);
    std::vector<std::uint32_t> front;
    for (std::size_t n = 0; n < boundary_.size(); ++n) {
      if (dot(normals_[n], direction) > -kFacing * length(direction)) continue;
      steps[boundary_[n]] = 0;
      front.push_back(boundary_[n]);
    }
    std::vector<std::uint32_t> beyond;
    for (int depth = 1; depth < std::min<int>(layers_, kFar); ++depth) {
      beyond.clear();
      for (const std::uint32_t at : front) {
        for (std::size_t e = first_[at]; e < first_[at + 1]; ++e) {
          const std::uint32_t next = ends_[e];
          if (steps[next] != kFar) continue;
          steps[next] = static_cast<std::uint8_t>(depth);
          if (side_[next] == kNone) beyond.push_back(next);
        }
      }
      front.swap(beyond);
    }
    return steps;
  }

  /// The fewest edges, below layers_, from vertex n of the boundary to the other side, and the middle of the way;
  /// layers_ if there is no such way. steps: to what may be opposite to it.
  ThinPlace across(std::uint32_t n, const Steps& steps, Scratch& scratch) const {
    const std::uint32_t from = boundary_[n];
    const ThinPlace none{point(from), layers_};
    if (steps[from] >= layers_) return none;
    std::vector<std::uint32_t>& seen = scratch.seen;
    seen.assign(1, from);
    scratch.marks[from] = n;
    std::size_t begin = 0;
    for (int depth = 1; depth < layers_; ++depth) {
      const std::size_t end = seen.size();
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t at = seen[i];
        for (std::size_t e = first_[at]; e < first_[at + 1]; ++e) {
          const std::uint32_t next = ends_[e];
          if (scratch.marks[next] == n) continue;
          scratch.marks[next] = n;
          if (side_[next] == kNone) {
            if (depth + steps[next] < layers_) seen.push_back(next);
          } else if (steps[next] == 0 && is_across(n, side_[next])) {
            return {lerp(point(from), point(next), 0.5), depth};
          }
        }
      }
      begin = end;
    }
    return none;
  }

  /// Of two vertices of the boundary.
  bool is_across(std::uint32_t from, std::uint32_t to) const {
    const Vec& normal = normals_[from];
    if (dot(normals_[to], normal) > -kOpposite) return false;
    const Vec way = point(boundary_[to]) - point(boundary_[from]);
    const double size = length(way);
    return size >= thinnest_mm_ && -dot(way, normal) >= kInward * size;
  }

  const Point& point(std::uint32_t vertex) const { return mesh_.vertices[vertices_[vertex]]; }

  const TetMesh& mesh_;
  int layers_;
  double thinnest_mm_;
  std::vector<std::uint32_t> number_;    // of the mesh's vertices; kNone of those not in the region
  std::vector<VertexId> vertices_;       // the mesh's
  std::vector<std::uint32_t> boundary_;  // the vertices on it, ascending
  std::vector<std::uint32_t> side_;      // of each vertex its place in boundary_; kNone if it has none
  std::vector<Vec> normals_;             // of boundary_, outward
  std::vector<std::size_t> first_;       // of each vertex its first edge's place in ends_; one more at the end
  std::vector<std::uint32_t> ends_;
};

}  // namespace

std::optional<LayerCheck> check_layers(const TetMesh& mesh, const std::set<Region>& regions, int layers,
                                       double thinnest_mm, const Progress& progress) {
  LayerCheck check;
  const bool done = run_interruptible(progress, [&] {
    for (const Region region : regions) {
      const RegionEdges edges(mesh, region, layers, thinnest_mm);
      const std::vector<ThinPlace> found = edges.thin_places();
      check.vertices += edges.boundary_size();
      check.broken += found.size();
      check.places.insert(check.places.end(), found.begin(), found.end());
    }
  });
  if (!done) return std::nullopt;
  std::stable_sort(check.places.begin(), check.places.end(),
                   [](const ThinPlace& a, const ThinPlace& b) { return a.layers < b.layers; });
  if (check.places.size() > kMostThinPlaces) check.places.resize(kMostThinPlaces);
  return check;
}

}  // namespace scantet
