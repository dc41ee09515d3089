// Every boundary facet has two sides, each in a region (the outside is one). Round an edge, the sides of one region
// must be two; they are joined to surfaces. Where two sides of a region meet at an edge, their corners at its ends are
// joined too: the sides of a region at a vertex then fall into fans, of which there must be one.
#include <algorithm>
#include <atomic>
#include <functional>

#include "scantet/base/parallel.h"
#include "scantet/base/tet_volume.h"
#include "scantet/base/union_find.h"
#include "scantet/check/audit_impl.h"
#include "scantet/check/facet_crossings.h"

namespace scantet::auditing {
namespace {

/// Side 2·f is the side of face f that looks into the tet behind, 2·f + 1 the other.
using Side = std::uint32_t;

struct EdgeUse {
  std::uint64_t edge;  ///< its two vertices, ascending
  std::uint32_t face;
  std::uint32_t opposite;  ///< corner of the face that is not on the edge
  friend auto operator<=>(const EdgeUse&, const EdgeUse&) = default;
};

struct SideUse {
  Region region;
  Side side;
  std::uint32_t opposite;
  friend auto operator<=>(const SideUse&, const SideUse&) = default;
};

struct Surface {
  std::uint32_t component = kNone;  ///< of the mesh; kNone on the outside
  Point from;                       ///< its first vertex, where volumes are measured from
  std::int64_t euler = 0;
  double volume_mm3 = 0;  ///< enclosed; negative if its region is around it
  Box box_mm;
};

class BoundaryCheck {
 public:
  BoundaryCheck(const TetMesh& mesh, const FaceMatch& match, const std::vector<std::uint32_t>& component_of)
      : mesh_(mesh),
        faces_(match.boundary),
        component_of_(component_of),
        pieces_(faces_.size()),
        surfaces_(2 * faces_.size()),
        fans_(6 * faces_.size()),
        edges_of_side_(2 * faces_.size(), 0) {}

  void run(AuditReport& report) {
    walk_edges();
    number_surfaces();
    count_fans();
    report.non_manifold_edges = bad_edges_.count;
    report.non_manifold_vertices = bad_vertices_.count;
    record(bad_edges_, report);
    record(bad_vertices_, report);
    report.boundary_euler =
        static_cast<std::int64_t>(report.boundary_vertices) - edge_count_ + static_cast<std::int64_t>(faces_.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) report.boundary_components += pieces_.is_root(f) ? 1 : 0;
    describe_surfaces(report);
  }

  const OutsideSurfaces& outside() const { return outside_; }

 private:
  Region region_of(Side side) const {
    const BoundaryFace& face = faces_[side / 2];
    const std::uint32_t tet = side % 2 == 0 ? face.behind : face.front;
    return tet == kNone ? kOutside : mesh_.tet_regions[tet];
  }

  static std::uint32_t corner(Side side, std::uint32_t i) { return 3 * side + i; }

  std::vector<EdgeUse> edge_uses() const {
    std::vector<EdgeUse> uses(3 * faces_.size());
    parallel_for(faces_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const Triangle& v = faces_[f].vertices;
        const auto edge = [](VertexId a, VertexId b) { return (std::uint64_t{a} << 32) | b; };
        const auto face = static_cast<std::uint32_t>(f);
        uses[3 * f] = {edge(v[1], v[2]), face, 0};
        uses[3 * f + 1] = {edge(v[0], v[2]), face, 1};
        uses[3 * f + 2] = {edge(v[0], v[1]), face, 2};
      }
    });
    parallel_sort(uses, std::less<>());
    return uses;
  }

  void walk_edges() {
    const std::vector<EdgeUse> uses = edge_uses();
    const auto is_first = [&](std::size_t n) { return n == 0 || uses[n].edge != uses[n - 1].edge; };
    bad_edges_ =
        parallel_tally("audit.boundary_edge", uses.size(), [&](std::size_t begin, std::size_t end, Tally& bad) {
          std::vector<SideUse> sides;
          std::int64_t edges = 0;
          std::size_t use = begin;
          while (use < end && !is_first(use)) ++use;  // of an edge of the piece before
          for (; use < end; ++edges) {
            const EdgeUse& first = uses[use];
            sides.clear();
            for (; use < uses.size() && uses[use].edge == first.edge; ++use) {
              const std::uint32_t face = uses[use].face;
              pieces_.unite(first.face, face);
              for (const Side side : {2 * face, 2 * face + 1})
                sides.push_back({region_of(side), side, uses[use].opposite});
            }
            std::sort(sides.begin(), sides.end());
            visit_edge(first.edge, sides, bad);
          }
          edge_count_ += edges;
        });
  }

  /// Called by several threads at once.
  void visit_edge(std::uint64_t edge, const std::vector<SideUse>& sides, Tally& bad) {
    bool manifold = true;
    for (std::size_t begin = 0; begin < sides.size();) {
      std::size_t end = begin + 1;
      for (; end < sides.size() && sides[end].region == sides[begin].region; ++end) join(sides[end - 1], sides[end]);
      manifold = manifold && end - begin == 2;
      ++std::atomic_ref(edges_of_side_[sides[begin].side]);
      begin = end;
    }
    if (manifold) return;
    const auto a = static_cast<VertexId>(edge >> 32);
    const auto b = static_cast<VertexId>(edge);
    bad.hit(0.5 * (mesh_.vertices[a] + mesh_.vertices[b]),
            [&] { return named("the edge", a) + ", " + std::to_string(b); });
  }

  // The edge's lower end is the lower of the two corners that are not opposite, in both faces.
  void join(const SideUse& a, const SideUse& b) {
    constexpr std::uint32_t kLower[3] = {1, 0, 0};
    constexpr std::uint32_t kUpper[3] = {2, 2, 1};
    surfaces_.unite(a.side, b.side);
    fans_.unite(corner(a.side, kLower[a.opposite]), corner(b.side, kLower[b.opposite]));
    fans_.unite(corner(a.side, kUpper[a.opposite]), corner(b.side, kUpper[b.opposite]));
  }

  void number_surfaces() {
    number_of_root_.assign(surfaces_.size(), kNone);
    std::uint32_t count = 0;
    for (Side side = 0; side < surfaces_.size(); ++side) {
      if (surfaces_.is_root(side)) number_of_root_[side] = count++;
    }
    vertices_of_surface_.assign(count, 0);
  }

  std::uint32_t surface_of(Side side) { return number_of_root_[surfaces_.find(side)]; }

  void count_fans() {
    struct Fan {
      VertexId vertex;
      Region region;
      std::uint32_t surface;
      auto operator<=>(const Fan&) const = default;
    };
    std::vector<Fan> fans =
        parallel_collect<Fan>(fans_.size(), kGrain, [&](std::size_t begin, std::size_t end, std::vector<Fan>& found) {
          for (auto c = static_cast<std::uint32_t>(begin); c < end; ++c) {
            if (!fans_.is_root(c)) continue;
            const Side side = c / 3;
            found.push_back({faces_[side / 2].vertices[c % 3], region_of(side), surface_of(side)});
          }
        });
    parallel_sort(fans, std::less<>());
    VertexId last_bad = kNone;
    for (std::size_t i = 0; i < fans.size(); ++i) {
      const Fan& fan = fans[i];
      const bool again = i > 0 && fans[i - 1].vertex == fan.vertex && fans[i - 1].region == fan.region;
      if (!again || fans[i - 1].surface != fan.surface) ++vertices_of_surface_[fan.surface];
      if (!again || fan.vertex == last_bad) continue;
      last_bad = fan.vertex;
      bad_vertices_.hit(mesh_.vertices[fan.vertex], [&] { return named("vertex", fan.vertex); });
    }
  }

  // Six times the volume between the face and `from`, positive if the face looks away from it.
  double cone(const BoundaryFace& face, const Point& from) const {
    const Point& a = mesh_.vertices[face.vertices[0]];
    const Point& b = mesh_.vertices[face.vertices[1]];
    const Point& c = mesh_.vertices[face.vertices[2]];
    const double size = orientation_mm3(from, a, b, c);
    return orientation_mm3(a, b, c, mesh_.vertices[face.apex]) > 0 ? -size : size;
  }

  void describe_surfaces(AuditReport& report) {
    std::vector<Surface> surfaces(vertices_of_surface_.size());
    for (Side side = 0; side < surfaces_.size(); ++side) {
      Surface& surface = surfaces[surface_of(side)];
      const BoundaryFace& face = faces_[side / 2];
      if (surfaces_.is_root(side)) {
        const std::uint32_t tet = side % 2 == 0 ? face.behind : face.front;
        if (tet != kNone) surface.component = component_of_[tet];
        surface.from = mesh_.vertices[face.vertices[0]];
      }
      surface.euler += 1 - edges_of_side_[side];
      const double volume = cone(face, surface.from) / 6;
      // `cone` is oriented out of the tet behind, for the side in front of it as well.
      surface.volume_mm3 += side % 2 == 0 ? volume : -volume;
      for (const VertexId v : face.vertices) surface.box_mm.extend(mesh_.vertices[v]);
    }
    std::vector<std::uint32_t> number_of(surfaces.size(), kNone);
    for (std::size_t n = 0; n < surfaces.size(); ++n) {
      const Surface& surface = surfaces[n];
      const std::int64_t euler = surface.euler + vertices_of_surface_[n];
      if (surface.component == kNone) {
        number_of[n] = static_cast<std::uint32_t>(outside_.euler.size());
        outside_.euler.push_back(euler);
        const bool is_wall = surface.volume_mm3 > 0;
        outside_.cavity.push_back(is_wall ? static_cast<std::uint32_t>(report.cavity_walls.size()) : kNone);
        if (is_wall) report.cavity_walls.push_back({0, euler, surface.volume_mm3, surface.box_mm});
        continue;
      }
      report.surfaces.push_back({surface.component, euler, surface.volume_mm3, surface.box_mm});
      MeshComponent& component = report.components[surface.component];
      ++component.surfaces;
      component.boundary_euler += euler;
    }
    report.cavities = report.cavity_walls.size();
    outside_.of_face.reserve(faces_.size());
    for (Side front = 1; front < surfaces_.size(); front += 2) {
      outside_.of_face.push_back(number_of[surface_of(front)]);
    }
  }

  static constexpr std::size_t kGrain = 8192;

  const TetMesh& mesh_;
  const std::vector<BoundaryFace>& faces_;
  const std::vector<std::uint32_t>& component_of_;
  ParallelUnionFind pieces_;                       // of faces that share an edge
  ParallelUnionFind surfaces_;                     // of sides that share an edge and a region
  ParallelUnionFind fans_;                         // of the corners of sides
  std::vector<std::int32_t> edges_of_side_;        // edges counted at one of their sides
  std::vector<std::uint32_t> number_of_root_;      // by side: of the surface that it stands for
  std::vector<std::int64_t> vertices_of_surface_;  // by its number
  std::atomic<std::int64_t> edge_count_ = 0;
  OutsideSurfaces outside_;
  Tally bad_edges_{"audit.boundary_edge"};
  Tally bad_vertices_{"audit.boundary_vertex"};
};

/// One tet at a vertex that more than one piece touches.
struct Touch {
  VertexId vertex;
  Region region;
  std::uint32_t piece;
  friend auto operator<=>(const Touch&, const Touch&) = default;
};

std::uint64_t count_vertex_components(const TetMesh& mesh, const std::vector<std::uint32_t>& component_of,
                                      std::size_t components) {
  std::vector<std::uint32_t> first(mesh.vertices.size(), kNone);
  std::vector<std::uint8_t> shared(mesh.vertices.size(), 0);
  const auto for_each_use = [&](const auto& visit) {
    for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
      if (component_of[i] == kNone) continue;
      for (const VertexId v : mesh.tets[i]) visit(v, i);
    }
  };
  for_each_use([&](VertexId v, std::size_t i) {
    if (first[v] == kNone) first[v] = component_of[i];
    if (first[v] != component_of[i]) shared[v] = 1;
  });
  std::vector<Touch> touches;
  for_each_use([&](VertexId v, std::size_t i) {
    if (shared[v] != 0) touches.push_back({v, mesh.tet_regions[i], component_of[i]});
  });
  std::sort(touches.begin(), touches.end());
  UnionFind joined(components);
  std::uint64_t count = components;
  for (std::size_t i = 1; i < touches.size(); ++i) {
    const Touch& a = touches[i - 1];
    const Touch& b = touches[i];
    if (a.vertex != b.vertex || a.region != b.region || joined.find(a.piece) == joined.find(b.piece)) continue;
    joined.unite(a.piece, b.piece);
    --count;
  }
  return count;
}

}  // namespace

std::vector<std::uint32_t> list_components(const TetMesh& mesh, FaceMatch& match, AuditReport& report) {
  constexpr std::size_t kGrain = 65'536;
  const auto collect_roots = [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& roots) {
    for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
      if (match.repeated[i] == 0 && match.pieces.is_root(i)) roots.push_back(i);
    }
  };
  std::vector<std::uint32_t> component_of(mesh.tets.size(), kNone);
  for (const std::uint32_t root : parallel_collect<std::uint32_t>(mesh.tets.size(), kGrain, collect_roots)) {
    component_of[root] = static_cast<std::uint32_t>(report.components.size());
    report.components.emplace_back().region = mesh.tet_regions[root];
  }
  parallel_for(mesh.tets.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
      if (match.repeated[i] != 0 || match.pieces.is_root(i)) continue;
      component_of[i] = component_of[match.pieces.find(i)];
    }
  });
  return component_of;
}

void measure_components(const TetMesh& mesh, const std::vector<std::uint32_t>& component_of, AuditReport& report) {
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    if (component_of[i] == kNone) continue;
    MeshComponent& component = report.components[component_of[i]];
    ++component.tets;
    component.volume_mm3 += tet_volume_mm3(mesh, i);
    for (const VertexId v : mesh.tets[i]) component.box_mm.extend(mesh.vertices[v]);
  }
  report.vertex_components = count_vertex_components(mesh, component_of, report.components.size());
}

OutsideSurfaces check_boundary(const TetMesh& mesh, const FaceMatch& match,
                               const std::vector<std::uint32_t>& component_of, AuditReport& report) {
  BoundaryCheck check(mesh, match, component_of);
  check.run(report);
  return check.outside();
}

void check_crossings(const TetMesh& mesh, AuditReport& report) {
  const auto is_known = [&](const Triangle& f) { return std::ranges::max(f) < mesh.vertices.size(); };
  const auto says_more = [](const Finding& finding) {
    constexpr std::array kOverlaps{"audit.orientation", "audit.crowded_face", "audit.folded_face"};
    return std::ranges::find(kOverlaps, finding.code) != kOverlaps.end();
  };
  if (!std::ranges::all_of(mesh.boundary_facets, is_known) || std::ranges::any_of(report.findings, says_more)) return;
  Tally tally("audit.crossing");
  for (const std::uint32_t f : crossing_facets(mesh)) {
    tally.hit(mesh.vertices[mesh.boundary_facets[f][0]], [&] { return named("facet", f); });
  }
  record(tally, report);
}

}  // namespace scantet::auditing
