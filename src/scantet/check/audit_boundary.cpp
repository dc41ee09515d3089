// Every boundary facet has two sides, each in a region (the outside is one). Round an edge, the sides of one region
// must be two; they are joined to surfaces. Where two sides of a region meet at an edge, their corners at its ends are
// joined too: the sides of a region at a vertex then fall into fans, of which there must be one.
#include <algorithm>
#include <functional>

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
  Region region = kOutside;
  std::uint32_t component = kNone;  ///< of the mesh; kNone on the outside
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

  void walk_edges() {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * faces_.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      const Triangle& v = faces_[f].vertices;
      const auto edge = [](VertexId a, VertexId b) { return (std::uint64_t{a} << 32) | b; };
      uses.push_back({edge(v[1], v[2]), f, 0});
      uses.push_back({edge(v[0], v[2]), f, 1});
      uses.push_back({edge(v[0], v[1]), f, 2});
    }
    parallel_sort(uses, std::less<>());
    std::vector<SideUse> sides;
    for (std::size_t begin = 0; begin < uses.size();) {
      sides.clear();
      std::size_t end = begin;
      for (; end < uses.size() && uses[end].edge == uses[begin].edge; ++end) {
        const EdgeUse& use = uses[end];
        pieces_.unite(uses[begin].face, use.face);
        for (const Side side : {2 * use.face, 2 * use.face + 1}) sides.push_back({region_of(side), side, use.opposite});
      }
      std::sort(sides.begin(), sides.end());
      visit_edge(uses[begin].edge, sides);
      begin = end;
    }
  }

  void visit_edge(std::uint64_t edge, const std::vector<SideUse>& sides) {
    ++edge_count_;
    bool manifold = true;
    for (std::size_t begin = 0; begin < sides.size();) {
      std::size_t end = begin + 1;
      for (; end < sides.size() && sides[end].region == sides[begin].region; ++end) join(sides[end - 1], sides[end]);
      manifold = manifold && end - begin == 2;
      ++edges_of_side_[sides[begin].side];
      begin = end;
    }
    if (manifold) return;
    const auto a = static_cast<VertexId>(edge >> 32);
    const auto b = static_cast<VertexId>(edge);
    bad_edges_.hit(0.5 * (mesh_.vertices[a] + mesh_.vertices[b]),
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

  void count_fans() {
    struct Fan {
      VertexId vertex;
      Region region;
      std::uint32_t surface;
      auto operator<=>(const Fan&) const = default;
    };
    std::vector<Fan> fans;
    for (std::uint32_t c = 0; c < fans_.size(); ++c) {
      if (!fans_.is_root(c)) continue;
      const Side side = c / 3;
      fans.push_back({faces_[side / 2].vertices[c % 3], region_of(side), surfaces_.find(side)});
    }
    parallel_sort(fans, std::less<>());
    vertices_of_surface_.assign(surfaces_.size(), 0);
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
    std::vector<Surface> surfaces(surfaces_.size());
    for (Side side = 0; side < surfaces.size(); ++side) {
      const Side root = surfaces_.find(side);
      Surface& surface = surfaces[root];
      const BoundaryFace& face = faces_[side / 2];
      const std::uint32_t tet = side % 2 == 0 ? face.behind : face.front;
      surface.region = region_of(side);
      if (tet != kNone) surface.component = component_of_[tet];
      surface.euler += 1 - edges_of_side_[side];
      const double volume = cone(face, mesh_.vertices[faces_[root / 2].vertices[0]]) / 6;
      // `cone` is oriented out of the tet behind, for the side in front of it as well.
      surface.volume_mm3 += side % 2 == 0 ? volume : -volume;
      for (const VertexId v : face.vertices) surface.box_mm.extend(mesh_.vertices[v]);
    }
    std::vector<std::uint32_t> number_of(surfaces.size(), kNone);
    for (Side side = 0; side < surfaces.size(); ++side) {
      if (!surfaces_.is_root(side)) continue;
      const Surface& surface = surfaces[side];
      const std::int64_t euler = surface.euler + vertices_of_surface_[side];
      if (surface.component == kNone) {
        number_of[side] = static_cast<std::uint32_t>(outside_.euler.size());
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
    for (Side front = 1; front < surfaces.size(); front += 2) {
      outside_.of_face.push_back(number_of[surfaces_.find(front)]);
    }
  }

  const TetMesh& mesh_;
  const std::vector<BoundaryFace>& faces_;
  const std::vector<std::uint32_t>& component_of_;
  ParallelUnionFind pieces_;                       // of faces that share an edge
  ParallelUnionFind surfaces_;                     // of sides that share an edge and a region
  ParallelUnionFind fans_;                         // of the corners of sides
  std::vector<std::int32_t> edges_of_side_;        // edges counted at one of their sides
  std::vector<std::int64_t> vertices_of_surface_;  // by the side that stands for it
  std::int64_t edge_count_ = 0;
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
  std::vector<std::uint32_t> component_of(mesh.tets.size(), kNone);
  for (std::uint32_t i = 0; i < mesh.tets.size(); ++i) {
    if (match.repeated[i] != 0) continue;
    const std::uint32_t root = match.pieces.find(i);
    if (root == i) {
      component_of[i] = static_cast<std::uint32_t>(report.components.size());
      report.components.push_back({});
      report.components.back().region = mesh.tet_regions[i];
    }
    component_of[i] = component_of[root];
    MeshComponent& component = report.components[component_of[i]];
    ++component.tets;
    component.volume_mm3 += tet_volume_mm3(mesh, i);
    for (const VertexId v : mesh.tets[i]) component.box_mm.extend(mesh.vertices[v]);
  }
  report.vertex_components = count_vertex_components(mesh, component_of, report.components.size());
  return component_of;
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
