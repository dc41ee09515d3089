#include "scantet/verify/shell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "scantet/base/parallel.h"
#include "scantet/base/union_find.h"
#include "scantet/verify/box_tree.h"
#include "scantet/verify/exact_sign.h"
#include "scantet/verify/findings.h"

namespace scantet::verify {
namespace {

/// The faces of a tet that is positively oriented, seen from outside; each with the vertex opposite to it left out.
constexpr std::array<std::array<int, 3>, 4> kFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct Face {
  Triangle key;  // ascending
  std::uint32_t tet;
  std::uint8_t face;
  std::uint8_t is_odd;  // whether the face, seen from outside, is an odd permutation of the key

  friend bool operator<(const Face& a, const Face& b) {
    return std::tie(a.key, a.tet, a.face) < std::tie(b.key, b.tet, b.face);
  }
};

Face make_face(const Tet& tet, std::uint32_t index, std::uint8_t face) {
  Face f{{}, index, face, 0};
  for (std::size_t n = 0; n < 3; ++n) f.key[n] = tet[static_cast<std::size_t>(kFaces[face][n])];
  const auto order = [&](std::size_t a, std::size_t b) {
    if (f.key[a] <= f.key[b]) return;
    std::swap(f.key[a], f.key[b]);
    f.is_odd ^= 1;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return f;
}

std::vector<Face> all_faces(const TetMesh& mesh) {
  std::vector<Face> faces(mesh.tets.size() * 4);
  parallel_for(mesh.tets.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      for (std::uint8_t f = 0; f < 4; ++f) faces[4 * t + f] = make_face(mesh.tets[t], static_cast<std::uint32_t>(t), f);
    }
  });
  parallel_sort(faces, std::less<>());
  return faces;
}

Point face_center(const TetMesh& mesh, const Triangle& face) {
  return (1.0 / 3) * (mesh.vertices[face[0]] + mesh.vertices[face[1]] + mesh.vertices[face[2]]);
}

/// Facets, with vertices of the mesh; tets that share faces are united in `tets`.
void take_boundary(const TetMesh& mesh, const std::vector<Face>& faces, Shell& shell, UnionFind& tets,
                   FindingList& faults) {
  for (std::size_t begin = 0, end; begin < faces.size(); begin = end) {
    end = begin + 1;
    while (end < faces.size() && faces[end].key == faces[begin].key) ++end;
    const Face& face = faces[begin];
    if (end - begin == 1) {
      Triangle facet = face.key;
      if (face.is_odd) std::swap(facet[1], facet[2]);
      shell.facets.push_back(facet);
      shell.tet_behind.push_back(face.tet);
      continue;
    }
    if (end - begin > 2) {
      faults.add("face.shared", "a face belongs to more than two tets", face_center(mesh, face.key));
    } else if (face.is_odd == faces[begin + 1].is_odd) {
      faults.add("face.same_side", "two tets lie on the same side of a face", face_center(mesh, face.key));
    }
    for (std::size_t n = begin + 1; n < end; ++n) tets.unite(face.tet, faces[n].tet);
  }
}

void number_vertices(Shell& shell) {
  for (const Triangle& facet : shell.facets) shell.vertices.insert(shell.vertices.end(), facet.begin(), facet.end());
  parallel_sort(shell.vertices, std::less<>());
  shell.vertices.erase(std::unique(shell.vertices.begin(), shell.vertices.end()), shell.vertices.end());
  for (Triangle& facet : shell.facets) {
    for (VertexId& v : facet) {
      v = static_cast<VertexId>(std::lower_bound(shell.vertices.begin(), shell.vertices.end(), v) -
                                shell.vertices.begin());
    }
  }
}

void make_stars(Shell& shell) {
  shell.star_begin.assign(shell.vertices.size() + 1, 0);
  for (const Triangle& facet : shell.facets) {
    for (const VertexId v : facet) ++shell.star_begin[v + 1];
  }
  std::partial_sum(shell.star_begin.begin(), shell.star_begin.end(), shell.star_begin.begin());
  std::vector<std::uint32_t> next(shell.star_begin.begin(), shell.star_begin.end() - 1);
  shell.star.resize(3 * shell.facets.size());
  for (std::uint32_t f = 0; f < shell.facets.size(); ++f) {
    for (const VertexId v : shell.facets[f]) shell.star[next[v]++] = f;
  }
}

/// Whether the facets of v follow each other once around it; sorts them in that order if so.
bool sort_star(Shell& shell, std::uint32_t v) {
  const auto begin = shell.star.begin() + shell.star_begin[v];
  const auto end = shell.star.begin() + shell.star_begin[v + 1];
  const auto after = [&](std::uint32_t f, std::size_t step) {
    const Triangle& facet = shell.facets[f];
    const auto at = static_cast<std::size_t>(std::find(facet.begin(), facet.end(), v) - facet.begin());
    return facet[(at + step) % 3];
  };
  for (auto f = begin; f + 1 < end; ++f) {
    const VertexId shared = after(*f, 2);
    const auto next = std::find_if(f + 1, end, [&](std::uint32_t g) { return after(g, 1) == shared; });
    if (next == end) return false;
    std::iter_swap(f + 1, next);
  }
  if (end - begin < 3 || after(*(end - 1), 2) != after(*begin, 1)) return false;
  std::vector<VertexId> link;
  for (auto f = begin; f < end; ++f) link.push_back(after(*f, 1));
  std::sort(link.begin(), link.end());
  return std::adjacent_find(link.begin(), link.end()) == link.end();
}

struct Side {
  std::array<VertexId, 2> key;  // ascending
  std::uint32_t facet;
  bool is_forward;
};

/// Whether every edge has two facets that run along it in opposite directions; components and their Euler numbers.
void join_facets(const TetMesh& mesh, Shell& shell, FindingList& faults) {
  std::vector<Side> sides;
  sides.reserve(3 * shell.facets.size());
  for (std::uint32_t f = 0; f < shell.facets.size(); ++f) {
    for (std::size_t n = 0; n < 3; ++n) {
      const VertexId a = shell.facets[f][n];
      const VertexId b = shell.facets[f][(n + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, f, a < b});
    }
  }
  parallel_sort(sides,
                [](const Side& a, const Side& b) { return std::tie(a.key, a.facet) < std::tie(b.key, b.facet); });
  UnionFind sets;
  for (std::size_t f = 0; f < shell.facets.size(); ++f) sets.add();
  std::vector<std::uint32_t> first_of_edge;
  shell.is_closed = true;
  for (std::size_t begin = 0, end; begin < sides.size(); begin = end) {
    end = begin + 1;
    while (end < sides.size() && sides[end].key == sides[begin].key) ++end;
    if (end - begin != 2 || sides[begin].is_forward == sides[begin + 1].is_forward) {
      shell.is_closed = false;
      const auto& key = sides[begin].key;
      faults.add("boundary.edge", "the boundary is no surface along an edge",
                 lerp(mesh.vertices[shell.vertices[key[0]]], mesh.vertices[shell.vertices[key[1]]], 0.5));
    }
    for (std::size_t n = begin + 1; n < end; ++n) sets.unite(sides[begin].facet, sides[n].facet);
    first_of_edge.push_back(sides[begin].facet);
  }
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> number(shell.facets.size(), kNone);
  shell.component.resize(shell.facets.size());
  for (std::uint32_t f = 0; f < shell.facets.size(); ++f) {
    std::uint32_t& n = number[sets.find(f)];
    if (n == kNone) {
      n = static_cast<std::uint32_t>(shell.first.size());
      shell.first.push_back(f);
      shell.euler.push_back(0);
    }
    shell.component[f] = n;
    ++shell.euler[n];
  }
  for (const std::uint32_t f : first_of_edge) --shell.euler[shell.component[f]];
  for (std::size_t v = 0; v < shell.vertices.size(); ++v)
    ++shell.euler[shell.component[shell.star[shell.star_begin[v]]]];
}

void check_tets(const TetMesh& mesh, FindingList& faults) {
  const auto bad =
      parallel_collect<std::uint32_t>(mesh.tets.size(), 2048, [&](std::size_t begin, std::size_t end, auto& out) {
        for (std::size_t t = begin; t < end; ++t) {
          const Tet& tet = mesh.tets[t];
          if (orientation(mesh.vertices[tet[0]], mesh.vertices[tet[1]], mesh.vertices[tet[2]], mesh.vertices[tet[3]]) <=
              0) {
            out.push_back(static_cast<std::uint32_t>(t));
          }
        }
      });
  for (const std::uint32_t t : bad) {
    const Tet& tet = mesh.tets[t];
    faults.add(
        "tet.not_positive", "a tet has no positive volume",
        0.25 * ((mesh.vertices[tet[0]] + mesh.vertices[tet[1]]) + (mesh.vertices[tet[2]] + mesh.vertices[tet[3]])));
  }
  for (std::size_t t = 1; t < mesh.tets.size(); ++t) {
    if (mesh.tet_regions[t] == mesh.tet_regions[0]) continue;
    faults.add("mesh.regions", "the mesh has several regions, and one level has one", mesh.vertices[mesh.tets[t][0]]);
  }
}

}  // namespace

Shell make_shell(const TetMesh& mesh, std::vector<VerifyFinding>& found) {
  FindingList faults(found);
  Shell shell;
  check_tets(mesh, faults);
  UnionFind tets;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) tets.add();
  take_boundary(mesh, all_faces(mesh), shell, tets, faults);
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) shell.tet_components += tets.find(t) == t;
  number_vertices(shell);
  make_stars(shell);
  shell.is_disc.assign(shell.vertices.size(), 0);
  for (std::uint32_t v = 0; v < shell.vertices.size(); ++v) {
    shell.is_disc[v] = sort_star(shell, v);
    if (shell.is_disc[v]) continue;
    faults.add("boundary.vertex", "the boundary is no surface at a vertex", mesh.vertices[shell.vertices[v]]);
  }
  join_facets(mesh, shell, faults);
  shell.is_manifold =
      shell.is_closed && std::find(shell.is_disc.begin(), shell.is_disc.end(), 0) == shell.is_disc.end();
  return shell;
}

struct BoundaryRays::Impl {
  const TetMesh& mesh;
  const Shell& shell;
  BoxTree tree;
  Box around;

  Point corner(std::uint32_t facet, std::size_t n) const {
    return mesh.vertices[shell.vertices[shell.facets[facet][n]]];
  }
};

BoundaryRays::BoundaryRays(const TetMesh& mesh, const Shell& shell) {
  std::vector<Box> boxes(shell.facets.size());
  Box around;
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    for (const VertexId v : shell.facets[f]) boxes[f].extend(mesh.vertices[shell.vertices[v]]);
    around.extend(boxes[f].min);
    around.extend(boxes[f].max);
  }
  impl_ = std::make_unique<Impl>(Impl{mesh, shell, BoxTree(std::move(boxes)), around});
}

BoundaryRays::~BoundaryRays() = default;

bool BoundaryRays::cast(const Point& p, std::vector<Hit>& hits) const {
  hits.clear();
  bool is_clear = true;
  const Box ray{p, {std::max(p.x, impl_->around.max.x), p.y, p.z}};
  impl_->tree.visit_meeting(ray, [&](std::uint32_t f) {
    const Point a = impl_->corner(f, 0);
    const Point b = impl_->corner(f, 1);
    const Point c = impl_->corner(f, 2);
    const int ab = orientation_yz(a, b, p);
    const int bc = orientation_yz(b, c, p);
    const int ca = orientation_yz(c, a, p);
    const bool outside = (ab < 0 || bc < 0 || ca < 0) && (ab > 0 || bc > 0 || ca > 0);
    if (outside) return;
    if (ab == 0 || bc == 0 || ca == 0) {
      is_clear = false;
      return;
    }
    // ab > 0: the facet's normal points along x; p is before it if it is on the other side.
    const int side = orientation(a, b, c, p);
    if (side == 0) is_clear = false;
    if (side * ab < 0) hits.push_back({f, ab});
  });
  return is_clear;
}

int BoundaryRays::coverage(const Point& p, std::vector<Hit>& hits, bool& has_moved) const {
  Point from = p;
  for (int attempt = 0; attempt < 10; ++attempt) {
    has_moved = attempt > 0;
    if (cast(from, hits)) {
      int sum = 0;
      for (const Hit& hit : hits) sum += hit.direction;
      return sum;
    }
    from = from + Vec{0, 1e-7 * (attempt + 1), 1.7e-7 * (attempt + 1)};
  }
  return -1;
}

bool check_coverage(const TetMesh& mesh, const Shell& shell, std::vector<VerifyFinding>& found) {
  FindingList faults(found);
  const BoundaryRays rays(mesh, shell);
  std::vector<BoundaryRays::Hit> hits;
  bool is_sure = true;
  for (const std::uint32_t facet : shell.first) {
    const Tet& tet = mesh.tets[shell.tet_behind[facet]];
    bool is_done = false;
    std::uint32_t random = 12345;
    for (int attempt = 0; attempt < 50 && !is_done; ++attempt) {
      std::array<double, 4> weight{};
      double sum = 0;
      for (double& w : weight) {
        random = random * 1664525U + 1013904223U;
        sum += w = 0.1 + (random >> 8) * 0x1p-24;
      }
      Point p;
      for (std::size_t n = 0; n < 4; ++n) p = p + (weight[n] / sum) * mesh.vertices[tet[n]];
      bool is_inside = true;
      for (const auto& face : kFaces) {
        is_inside = is_inside && orientation(mesh.vertices[tet[static_cast<std::size_t>(face[0])]],
                                             mesh.vertices[tet[static_cast<std::size_t>(face[1])]],
                                             mesh.vertices[tet[static_cast<std::size_t>(face[2])]], p) < 0;
      }
      if (!is_inside || !rays.cast(p, hits)) continue;
      is_done = true;
      int covered = 0;
      for (const auto& hit : hits) covered += hit.direction;
      if (covered == 1) continue;
      is_sure = false;
      faults.add("tets.overlap", "space is covered by several tets", p);
    }
    if (is_done) continue;
    is_sure = false;
    faults.add_undecided("tets.coverage", "it could not be decided how often space is covered", mesh.vertices[tet[0]],
                         false);
  }
  return is_sure;
}

}  // namespace scantet::verify
