// Faces are matched at their smallest vertex, by a small sort on the other two, in stretches of vertices side by side.
// From the groups come the checks of conformity, the boundary as the tets have it, which tets hang together, and the
// edges: those of a tet, but for the one between its two largest vertices, start at the smallest vertex of one of its
// faces.
#include <algorithm>
#include <functional>
#include <span>

#include "scantet/base/parallel.h"
#include "scantet/base/repeats.h"
#include "scantet/check/audit_impl.h"
#include "scantet/quality/orientation.h"

namespace scantet::auditing {
namespace {

/// One tet at a face of known smallest vertex, in an order by face, then by the tet's fourth vertex.
struct FaceUse {
  std::uint64_t face;  // the middle vertex, and the largest in the lower half
  std::uint64_t tet;  // the tet's fourth vertex, the apex; in the lower half twice the tet's number and the apex's side

  VertexId middle() const { return static_cast<VertexId>(face >> 32U); }
  VertexId largest() const { return static_cast<VertexId>(face); }
  VertexId apex() const { return static_cast<VertexId>(tet >> 32U); }
  std::uint32_t tet_index() const { return static_cast<std::uint32_t>(tet) / 2; }
  /// Of two positively oriented tets on either side of a face one is on the even side.
  bool is_even_side() const { return tet % 2 == 0; }
  friend auto operator<=>(const FaceUse&, const FaceUse&) = default;
};

/// The use of face `f` (opposite to vertex f) of a tet.
FaceUse face_use(const Tet& t, std::uint32_t tet, unsigned f) {
  std::array<VertexId, 3> v{t[(f + 1) % 4], t[(f + 2) % 4], t[(f + 3) % 4]};
  unsigned odd = (f + 1) % 2;  // whether the order of vertices, the apex last, is an odd one of the tet's
  const auto order = [&](std::size_t i, std::size_t k) {
    if (v[i] <= v[k]) return;
    std::swap(v[i], v[k]);
    odd ^= 1U;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return {std::uint64_t{v[1]} << 32U | v[2], std::uint64_t{t[f]} << 32U | (2 * tet + odd)};
}

/// Matches the faces of a stretch of vertices, the smallest of the faces', and notes what it finds in their order.
class FaceMatcher {
 public:
  /// pieces: the sets of tets that hang together.
  FaceMatcher(const TetMesh& mesh, const TetStars& stars, bool all_positive, ParallelUnionFind& pieces)
      : mesh_(mesh), stars_(stars), all_positive_(all_positive), pieces_(pieces) {}

  void run(std::size_t begin_vertex, std::size_t end_vertex) {
    for (std::size_t v = begin_vertex; v < end_vertex; ++v) {
      collect(v);
      std::sort(uses_.begin(), uses_.end());
      for (std::size_t begin = 0; begin < uses_.size();) {
        std::size_t end = begin + 1;
        while (end < uses_.size() && uses_[end].face == uses_[begin].face) ++end;
        const Triangle face{static_cast<VertexId>(v), uses_[begin].middle(), uses_[begin].largest()};
        visit_face(face, {uses_.data() + begin, end - begin});
        neighbours_.insert(neighbours_.end(), {face[1], face[2]});
        begin = end;
      }
      drop_repeats(neighbours_);
      edges_ += neighbours_.size();
    }
  }

  /// Adds what was found to that of the stretches before.
  void give(FaceMatch& match, Tally& same, Tally& crowded, Tally& folded) const {
    match.boundary.insert(match.boundary.end(), boundary_.begin(), boundary_.end());
    match.faces += faces_;
    match.edges += edges_;
    for (const std::uint32_t tet : repeats_) {
      if (match.repeated[tet] != 0) continue;
      match.repeated[tet] = 1;
      same.hit(centroid(mesh_, tet), [&] { return named("tet", tet); });
    }
    crowded.add(crowded_);
    folded.add(folded_);
  }

 private:
  // The faces whose smallest vertex it is, and the far ends of the edges of which no such face need have one.
  void collect(std::size_t v) {
    uses_.clear();
    neighbours_.clear();
    for (const std::uint32_t tet : stars_.of(v)) {
      const Tet& t = mesh_.tets[tet];
      const auto smaller = std::count_if(t.begin(), t.end(), [&](VertexId w) { return w < v; });
      if (smaller == 2) neighbours_.push_back(std::max({t[0], t[1], t[2], t[3]}));
      for (unsigned f = 0; f < 4; ++f) {
        const bool starts_here = smaller == 0 ? t[f] != v : smaller == 1 && t[f] < v;
        if (starts_here) uses_.push_back(face_use(t, tet, f));
      }
    }
  }

  // Uses of one face, by apex and tet: those with the apex of the one before are repeated tets.
  void visit_face(const Triangle& face, std::span<const FaceUse> uses) {
    ++faces_;
    const bool is_plain = uses.size() == 1 || (uses.size() == 2 && uses[0].apex() != uses[1].apex());
    if (!is_plain) {
      visit_crowd(face, uses);
    } else if (uses.size() == 1) {
      boundary_.push_back({face, uses[0].tet_index(), kNone, uses[0].apex()});
    } else {
      const bool ordered = uses[0].tet_index() < uses[1].tet_index();
      visit_pair(face, uses[ordered ? 0 : 1], uses[ordered ? 1 : 0]);
    }
  }

  // A face with repeated tets, or with more than two.
  void visit_crowd(const Triangle& face, std::span<const FaceUse> uses) {
    std::vector<FaceUse> kept;
    for (std::size_t i = 0; i < uses.size(); ++i) {
      if (i > 0 && uses[i].apex() == uses[i - 1].apex()) {
        repeats_.push_back(uses[i].tet_index());
      } else {
        kept.push_back(uses[i]);
      }
    }
    std::sort(kept.begin(), kept.end(),
              [](const FaceUse& a, const FaceUse& b) { return a.tet_index() < b.tet_index(); });
    if (kept.size() == 2) {
      visit_pair(face, kept[0], kept[1]);
      return;
    }
    if (kept.size() > 2) {
      crowded_.hit(centroid(mesh_, face), [&] {
        return named("the face", face[0]) + ", " + std::to_string(face[1]) + ", " + std::to_string(face[2]) + " with " +
               std::to_string(kept.size()) + " tets";
      });
    }
    boundary_.push_back({face, kept[0].tet_index(), kNone, kept[0].apex()});
    for (const FaceUse& use : kept) join_if_same_region(kept[0].tet_index(), use.tet_index());
  }

  void visit_pair(const Triangle& face, const FaceUse& a, const FaceUse& b) {
    const std::uint32_t tet_a = a.tet_index();
    const std::uint32_t tet_b = b.tet_index();
    const bool on_one_side =
        all_positive_ ? a.is_even_side() == b.is_even_side() : side(face, a.apex()) * side(face, b.apex()) > 0;
    if (on_one_side) {
      folded_.hit(centroid(mesh_, face),
                  [&] { return "between tets " + std::to_string(tet_a) + " and " + std::to_string(tet_b); });
    }
    const Region region_a = mesh_.tet_regions[tet_a];
    const Region region_b = mesh_.tet_regions[tet_b];
    if (region_a < region_b) boundary_.push_back({face, tet_a, tet_b, a.apex()});
    if (region_b < region_a) boundary_.push_back({face, tet_b, tet_a, b.apex()});
    join_if_same_region(tet_a, tet_b);
  }

  int side(const Triangle& face, VertexId apex) const {
    return orientation_sign(mesh_.vertices[face[0]], mesh_.vertices[face[1]], mesh_.vertices[face[2]],
                            mesh_.vertices[apex]);
  }

  void join_if_same_region(std::uint32_t a, std::uint32_t b) {
    if (mesh_.tet_regions[a] == mesh_.tet_regions[b] && a != b) pieces_.unite(a, b);
  }

  const TetMesh& mesh_;
  const TetStars& stars_;
  bool all_positive_;
  ParallelUnionFind& pieces_;
  std::vector<BoundaryFace> boundary_;
  std::vector<std::uint32_t> repeats_;
  std::uint64_t faces_ = 0;
  std::uint64_t edges_ = 0;
  std::vector<FaceUse> uses_;         // of the faces that start at a vertex
  std::vector<VertexId> neighbours_;  // of larger number
  Tally crowded_{"audit.crowded_face"};
  Tally folded_{"audit.folded_face"};
};

/// A listed facet, its vertices ascending.
struct ListedFacet {
  Triangle vertices;
  std::uint32_t index;
  friend auto operator<=>(const ListedFacet&, const ListedFacet&) = default;
};

std::vector<ListedFacet> listed_facets(const TetMesh& mesh) {
  std::vector<ListedFacet> listed;
  listed.reserve(mesh.boundary_facets.size());
  for (std::uint32_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    Triangle vertices = mesh.boundary_facets[i];
    std::sort(vertices.begin(), vertices.end());
    listed.push_back({vertices, i});
  }
  parallel_sort(listed, std::less<>());
  return listed;
}

/// Compares the facets as listed with the faces as they are.
class FacetComparison {
 public:
  explicit FacetComparison(const TetMesh& mesh) : mesh_(mesh) {}

  void run(const std::vector<BoundaryFace>& faces, AuditReport& report) {
    const std::vector<ListedFacet> listed = listed_facets(mesh_);
    auto next = listed.begin();
    for (const BoundaryFace& face : faces) {
      for (; next != listed.end() && next->vertices < face.vertices; ++next) hit_extra(*next);
      if (next == listed.end() || next->vertices != face.vertices) {
        missing_.hit(centroid(mesh_, face.vertices), [&] { return "a face of tet " + std::to_string(face.behind); });
        continue;
      }
      compare(face, *next++);
      for (; next != listed.end() && next->vertices == face.vertices; ++next) {
        twice_.hit(centroid(mesh_, face.vertices), [&] { return named("facet", next->index); });
      }
    }
    for (; next != listed.end(); ++next) hit_extra(*next);
    for (const Tally* tally : {&missing_, &extra_, &twice_, &regions_, &orientation_}) record(*tally, report);
  }

 private:
  void hit_extra(const ListedFacet& facet) {
    const bool valid = facet.vertices[2] < mesh_.vertices.size();
    extra_.hit(valid ? centroid(mesh_, facet.vertices) : Point{}, [&] { return named("facet", facet.index); });
  }

  void compare(const BoundaryFace& face, const ListedFacet& listed) {
    const auto& regions = mesh_.facet_regions[listed.index];
    const Region behind = mesh_.tet_regions[face.behind];
    const Region front = face.front == kNone ? kOutside : mesh_.tet_regions[face.front];
    const bool as_expected = regions[0] == behind && regions[1] == front;
    const bool turned = regions[0] == front && regions[1] == behind && front != kOutside;
    const auto describe = [&] { return named("facet", listed.index); };
    if (!as_expected && !turned) {
      regions_.hit(centroid(mesh_, face.vertices), describe);
      return;
    }
    // The tet behind must lie on the negative side of a facet's normal, so its apex must.
    const Triangle& f = mesh_.boundary_facets[listed.index];
    const int side =
        orientation_sign(mesh_.vertices[f[0]], mesh_.vertices[f[1]], mesh_.vertices[f[2]], mesh_.vertices[face.apex]);
    if ((turned ? -side : side) > 0) orientation_.hit(centroid(mesh_, face.vertices), describe);
  }

  const TetMesh& mesh_;
  Tally missing_{"audit.facet_missing"};
  Tally extra_{"audit.facet_extra"};
  Tally twice_{"audit.facet_twice"};
  Tally regions_{"audit.facet_regions"};
  Tally orientation_{"audit.facet_orientation"};
};

}  // namespace

FaceMatch match_faces(const TetMesh& mesh, const TetStars& stars, bool all_positive, AuditReport& report) {
  constexpr std::size_t kVertices = 4096;
  FaceMatch match{{}, ParallelUnionFind(mesh.tets.size()), std::vector<std::uint8_t>(mesh.tets.size(), 0)};
  std::vector<FaceMatcher> stretches((mesh.vertices.size() + kVertices - 1) / kVertices,
                                     FaceMatcher(mesh, stars, all_positive, match.pieces));
  parallel_for(mesh.vertices.size(), kVertices,
               [&](std::size_t begin, std::size_t end) { stretches[begin / kVertices].run(begin, end); });
  Tally same{"audit.same_tet"};
  Tally crowded{"audit.crowded_face"};
  Tally folded{"audit.folded_face"};
  for (const FaceMatcher& stretch : stretches) stretch.give(match, same, crowded, folded);
  for (const Tally* tally : {&same, &crowded, &folded}) record(*tally, report);
  return match;
}

void check_facets(const TetMesh& mesh, const FaceMatch& match, AuditReport& report) {
  FacetComparison(mesh).run(match.boundary, report);
  std::vector<std::uint8_t> seen(mesh.vertices.size(), 0);
  Tally misflagged{"audit.boundary_flag"};
  for (const BoundaryFace& face : match.boundary) {
    for (const VertexId v : face.vertices) {
      if (seen[v] != 0) continue;
      seen[v] = 1;
      ++report.boundary_vertices;
      if (!mesh.on_boundary(v)) misflagged.hit(mesh.vertices[v], [&] { return named("vertex", v); });
    }
  }
  for (VertexId v = 0; v < seen.size(); ++v) {
    if (seen[v] != 0 || !mesh.on_boundary(v)) continue;
    misflagged.hit(mesh.vertices[v], [&] { return named("vertex", v) + ", which is in no boundary facet"; });
  }
  record(misflagged, report);
}

}  // namespace scantet::auditing
