// Tets of both meshes are taken together: what is at the sites, what is across faces that only one of the meshes has
// between these regions, and behind a face of both the tets of both. As a mesh improves only where it is bad, and
// refinement changes only what is near its new points, nearly all faces are in both.
#include "scantet/app/graft.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "scantet/app/graft_impl.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"

namespace scantet {
namespace {

using grafting::kNone;
using grafting::Part;
using grafting::Sides;

constexpr std::size_t kGrain = 8192;

/// For each vertex of a mesh that of the other one at the same place; kNone if there is none.
std::vector<VertexId> match_vertices(const TetMesh& mesh, const TetMesh& other) {
  std::vector<VertexId> order(other.vertices.size());
  std::iota(order.begin(), order.end(), VertexId{0});
  const auto less = [&](const Point& a, const Point& b) { return lexicographically_less(a, b); };
  parallel_sort(order, [&](VertexId a, VertexId b) { return less(other.vertices[a], other.vertices[b]); });
  std::vector<VertexId> match(mesh.vertices.size(), kNone);
  parallel_for(match.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Point& p = mesh.vertices[v];
      const auto found = std::lower_bound(order.begin(), order.end(), p,
                                          [&](VertexId w, const Point& q) { return less(other.vertices[w], q); });
      if (found != order.end() && other.vertices[*found] == p) match[v] = *found;
    }
  });
  return match;
}

class Graft {
 public:
  Graft(const TetMesh& kept, const TetMesh& fresh)
      : kept_(kept), fresh_(fresh), match_(match_vertices(fresh, kept)), back_(kept.vertices.size(), kNone) {
    for (VertexId v = 0; v < match_.size(); ++v) {
      if (match_[v] != kNone) back_[match_[v]] = v;
    }
  }

  std::optional<TetMesh> run(const std::vector<GraftSite>& sites, std::optional<std::int64_t> missing_euler) {
    std::vector<Point> centers;
    double most_mm = 0;
    for (const GraftSite& site : sites) {
      centers.push_back(site.center);
      most_mm = std::max(most_mm, site.radius_mm);
    }
    const PointGrid grid(centers, most_mm);
    fresh_.add_at(sites, grid, most_mm);
    kept_.add_at(sites, grid, most_mm);
    while (kept_.is_mostly_kept() && fresh_.is_mostly_kept()) {
      const std::uint32_t fresh = fresh_.take_last();
      if (fresh != kNone) add_around(fresh, fresh_, match_, kept_);
      const std::uint32_t kept = kept_.take_last();
      if (kept != kNone) add_around(kept, kept_, back_, fresh_);
      if (fresh != kNone || kept != kNone) continue;
      if (missing_euler) grafting::put_back_other_topology(kept_, fresh_, match_, *missing_euler);
      return put_together();
    }
    return std::nullopt;
  }

 private:
  /// What must be taken with a tet of `own`. match: of its vertices those of `other`.
  static void add_around(std::uint32_t tet, Part& own, const std::vector<VertexId>& match, Part& other) {
    const auto region = [](const Part& part, std::uint32_t t) {
      return t == kNone ? kOutside : part.mesh().tet_regions[t];
    };
    for (int k = 0; k < 4; ++k) {
      const Triangle face = face_of(own.mesh().tets[tet], k);
      const std::uint32_t across = own.sides_of(face).front;
      const Triangle its{match[face[0]], match[face[1]], match[face[2]]};
      const bool has_all = std::find(its.begin(), its.end(), kNone) == its.end();
      const Sides sides = has_all ? other.sides_of(its) : Sides{};
      other.add(sides.behind);
      const bool is_alike = sides.behind != kNone && region(own, tet) == region(other, sides.behind) &&
                            region(own, across) == region(other, sides.front);
      if (is_alike) continue;
      other.add(sides.front);
      own.add(across);
    }
  }

  TetMesh put_together() const {
    const TetMesh& kept = kept_.mesh();
    const TetMesh& fresh = fresh_.mesh();
    constexpr VertexId kUsed = 0;
    std::vector<VertexId> of_kept(kept.vertices.size(), kNone);
    std::vector<VertexId> of_fresh(fresh.vertices.size(), kNone);
    for (std::uint32_t t = 0; t < kept.tets.size(); ++t) {
      if (kept_.holds(t)) continue;
      for (const VertexId v : kept.tets[t]) of_kept[v] = kUsed;
    }
    for (std::uint32_t t = 0; t < fresh.tets.size(); ++t) {
      if (!fresh_.holds(t)) continue;
      for (const VertexId v : fresh.tets[t]) (match_[v] == kNone ? of_fresh[v] : of_kept[match_[v]]) = kUsed;
    }
    TetMesh mesh;
    const auto number = [&](const std::vector<Point>& vertices, std::vector<VertexId>& numbers) {
      for (std::size_t v = 0; v < vertices.size(); ++v) {
        if (numbers[v] == kNone) continue;
        numbers[v] = static_cast<VertexId>(mesh.vertices.size());
        mesh.vertices.push_back(vertices[v]);
      }
    };
    number(kept.vertices, of_kept);
    number(fresh.vertices, of_fresh);
    const auto add = [&](const Tet& tet, Region region, const auto& number_of) {
      mesh.tets.push_back({number_of(tet[0]), number_of(tet[1]), number_of(tet[2]), number_of(tet[3])});
      mesh.tet_regions.push_back(region);
    };
    for (std::uint32_t t = 0; t < kept.tets.size(); ++t) {
      if (!kept_.holds(t)) add(kept.tets[t], kept.tet_regions[t], [&](VertexId v) { return of_kept[v]; });
    }
    const auto number_of = [&](VertexId v) { return match_[v] == kNone ? of_fresh[v] : of_kept[match_[v]]; };
    for (std::uint32_t t = 0; t < fresh.tets.size(); ++t) {
      if (fresh_.holds(t)) add(fresh.tets[t], fresh.tet_regions[t], number_of);
    }
    return mesh;
  }

  Part kept_;
  Part fresh_;
  std::vector<VertexId> match_;  // of fresh vertices those kept
  std::vector<VertexId> back_;   // of kept ones those that are fresh
};

bool has_sharp_curves(const TetMesh& mesh) {
  return std::any_of(mesh.curves.begin(), mesh.curves.end(), [](const MeshCurve& curve) { return curve.is_sharp; });
}

/// What the meshes call their regions and patches.
void set_names(const TetMesh& kept, const TetMesh& fresh, TetMesh& mesh) {
  mesh.region_names = kept.region_names;
  mesh.region_names.insert(fresh.region_names.begin(), fresh.region_names.end());
  mesh.patches = kept.patches;  // of those with the same regions the first one's name counts
  mesh.patches.insert(mesh.patches.end(), fresh.patches.begin(), fresh.patches.end());
}

}  // namespace

std::optional<TetMesh> graft(const TetMesh& kept, const TetMesh& fresh, const std::vector<GraftSite>& sites,
                             std::optional<std::int64_t> missing_euler) {
  if (sites.empty() || has_sharp_curves(kept) || has_sharp_curves(fresh)) return std::nullopt;
  std::optional<TetMesh> mesh = Graft(kept, fresh).run(sites, missing_euler);
  if (!mesh) return std::nullopt;
  set_names(kept, fresh, *mesh);
  build_boundary(*mesh);
  return mesh;
}

}  // namespace scantet
