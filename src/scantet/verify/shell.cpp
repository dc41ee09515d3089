#include "scantet/verify/shell.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/base/parallel_union_find.h"
#include "scantet/base/union_find.h"
#include "scantet/verify/exact_sign.h"
#include "scantet/verify/findings.h"

namespace scantet::verify {
namespace {

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

/// The faces of all tets, by their lowest vertices: those of vertex v from begin[v] to begin[v + 1], in any order.
struct FaceTable {
  explicit FaceTable(const TetMesh& mesh) : begin(mesh.vertices.size() + 1, 0), faces(4 * mesh.tets.size()) {
    for_faces(mesh, [&](const Face& face) { take_place(begin[face.key[0] + 1]); });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for_faces(mesh, [&](const Face& face) { faces[take_place(next[face.key[0]])] = face; });
  }

  std::vector<std::size_t> begin;
  std::vector<Face> faces;

 private:
  /// Side by side.
  template <class Act>
  static void for_faces(const TetMesh& mesh, const Act& act) {
    parallel_for(mesh.tets.size(), 4096, [&](std::size_t first, std::size_t end) {
      for (std::size_t t = first; t < end; ++t) {
        for (std::uint8_t f = 0; f < 4; ++f) act(make_face(mesh.tets[t], static_cast<std::uint32_t>(t), f));
      }
    });
  }
  static std::size_t take_place(std::size_t& count) {
    return std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed);
  }
};

/// A face that is of the boundary, or in which tets do not meet as they should.
struct FaceFinding {
  Face face;
  std::size_t tets;  // that have it: one on the boundary
};

Point face_center(const TetMesh& mesh, const Triangle& face) {
  return (1.0 / 3) * (mesh.vertices[face[0]] + mesh.vertices[face[1]] + mesh.vertices[face[2]]);
}

/// Unites tets that share faces. Return: in ascending order of their keys.
std::vector<FaceFinding> match_faces(FaceTable& table, ParallelUnionFind& tets) {
  return parallel_collect<FaceFinding>(
      table.begin.size() - 1, 2048, [&](std::size_t first, std::size_t last, auto& out) {
        const auto at = [&](std::size_t v) {
          return table.faces.begin() + static_cast<std::ptrdiff_t>(table.begin[v]);
        };
        for (std::size_t v = first; v < last; ++v) std::sort(at(v), at(v + 1));
        for (auto face = at(first), end = face; face != at(last); face = end) {
          end = std::find_if(face, at(last), [&](const Face& other) { return other.key != face->key; });
          const auto count = static_cast<std::size_t>(end - face);
          if (count != 2 || face->is_odd == face[1].is_odd) out.push_back({*face, count});
          for (auto other = face + 1; other != end; ++other) tets.unite(face->tet, other->tet);
        }
      });
}

/// Facets, with vertices of the mesh; tets that share faces are united in `tets`.
void take_boundary(const TetMesh& mesh, Shell& shell, ParallelUnionFind& tets, FindingList& faults) {
  FaceTable table(mesh);
  for (const auto& [face, count] : match_faces(table, tets)) {
    if (count == 1) {
      Triangle facet = face.key;
      if (face.is_odd) std::swap(facet[1], facet[2]);
      shell.facets.push_back(facet);
      shell.tet_behind.push_back(face.tet);
    } else if (count == 2) {
      faults.add("face.same_side", "two tets lie on the same side of a face", face_center(mesh, face.key));
    } else {
      faults.add("face.shared", "a face belongs to more than two tets", face_center(mesh, face.key));
    }
  }
}

void number_vertices(const TetMesh& mesh, Shell& shell) {
  std::vector<VertexId> number(mesh.vertices.size(), 0);
  for (const Triangle& facet : shell.facets) {
    for (const VertexId v : facet) number[v] = 1;
  }
  for (VertexId v = 0; v < number.size(); ++v) {
    if (number[v] == 0) continue;
    number[v] = static_cast<VertexId>(shell.vertices.size());
    shell.vertices.push_back(v);
  }
  for (Triangle& facet : shell.facets) {
    for (VertexId& v : facet) v = number[v];
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
  UnionFind sets(shell.facets.size());
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

/// All that follows from the facets.
void complete(const TetMesh& mesh, Shell& shell, FindingList& faults) {
  number_vertices(mesh, shell);
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
}

}  // namespace

Shell make_shell(const TetMesh& mesh, std::vector<VerifyFinding>& found) {
  FindingList faults(found);
  Shell shell;
  check_tets(mesh, faults);
  ParallelUnionFind tets(mesh.tets.size());
  take_boundary(mesh, shell, tets, faults);
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) shell.tet_components += tets.is_root(t);
  complete(mesh, shell, faults);
  return shell;
}

Shell make_shell(const TetMesh& mesh, std::vector<Triangle> facets, std::vector<VerifyFinding>& found) {
  FindingList faults(found);
  Shell shell;
  shell.facets = std::move(facets);
  complete(mesh, shell, faults);
  return shell;
}

}  // namespace scantet::verify
