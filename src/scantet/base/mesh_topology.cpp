// Faces are matched by a counting sort on their smallest vertex, then a small sort of the other two inside each bucket:
// a bucket holds some twenty faces and stays in cache, and only face codes (tet * 4 + face, 4 bytes) are kept for all.
#include "scantet/base/mesh_topology.h"

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/base/parallel_buckets.h"

namespace scantet {
namespace {

/// The other two vertices of a face, ascending, as one number.
using PairKey = std::uint64_t;

struct BucketEntry {
  PairKey key;
  std::uint32_t code;
  friend bool operator<(const BucketEntry& a, const BucketEntry& b) {
    return a.key != b.key ? a.key < b.key : a.code < b.code;
  }
};

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

PairKey pair_key(const Triangle& ascending) {
  return (PairKey{ascending[1]} << 32) | ascending[2];
}

TetFace decode(std::uint32_t code) {
  return {code / 4, static_cast<std::uint8_t>(code % 4)};
}

Triangle face_of(const TetMesh& mesh, std::uint32_t code) {
  return scantet::face_of(mesh.tets[code / 4], static_cast<int>(code % 4));
}

/// All faces grouped by their smallest vertex, in any order.
class FaceBuckets {
 public:
  explicit FaceBuckets(const TetMesh& mesh) : of_vertex_(mesh.vertices.size()) {
    constexpr std::size_t kMaxTets = std::size_t{1} << 30;
    if (mesh.tets.size() >= kMaxTets) {
      throw Error(Fault::input, "input.too_large",
                  "the mesh has " + std::to_string(mesh.tets.size()) + " tets, the limit is 2^30 - 1",
                  "split the mesh");
    }
    for_each(mesh, [&](VertexId smallest, std::uint32_t) { of_vertex_.count(smallest); });
    codes_.resize(of_vertex_.close());
    for_each(mesh, [&](VertexId smallest, std::uint32_t code) { codes_[of_vertex_.place(smallest)] = code; });
  }

  std::span<const std::uint32_t> of(std::size_t vertex) const {
    return {codes_.data() + of_vertex_.begin(vertex), codes_.data() + of_vertex_.end(vertex)};
  }

 private:
  template <class Visit>
  static void for_each(const TetMesh& mesh, const Visit& visit) {
    constexpr std::size_t kTets = 16384;
    parallel_for(mesh.tets.size(), kTets, [&](std::size_t begin, std::size_t end) {
      for (auto code = static_cast<std::uint32_t>(4 * begin); code < 4 * end; ++code) {
        const Triangle t = face_of(mesh, code);
        visit(std::min({t[0], t[1], t[2]}), code);
      }
    });
  }

  ParallelBuckets of_vertex_;
  std::vector<std::uint32_t> codes_;
};

/// Calls visit(code behind, {region behind, region in front}) for each boundary facet whose smallest vertex this is.
/// bucket: room for its faces.
template <typename Visit>
void for_each_boundary_face(const TetMesh& mesh, std::span<const std::uint32_t> codes, std::vector<BucketEntry>& bucket,
                            const Visit& visit) {
  bucket.clear();
  for (const std::uint32_t code : codes) bucket.push_back({pair_key(sorted(face_of(mesh, code))), code});
  std::sort(bucket.begin(), bucket.end());
  for (auto begin = bucket.begin(); begin != bucket.end();) {
    auto end = begin;
    while (end != bucket.end() && end->key == begin->key) ++end;
    const Region region = mesh.tet_regions[begin->code / 4];
    if (end - begin != 2) {
      visit(begin->code, std::array<Region, 2>{region, kOutside});
    } else {
      const std::uint32_t other_code = (begin + 1)->code;
      const Region other = mesh.tet_regions[other_code / 4];
      if (region < other) visit(begin->code, std::array<Region, 2>{region, other});
      if (other < region) visit(other_code, std::array<Region, 2>{other, region});
    }
    begin = end;
  }
}

bool negative(const TetMesh& mesh, const Tet& t) {
  return orientation_mm3(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]) < 0;
}

}  // namespace

Triangle face_of(const Tet& tet, int face) {
  constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const int* const corners = kFaces[face];
  return {tet[static_cast<std::size_t>(corners[0])], tet[static_cast<std::size_t>(corners[1])],
          tet[static_cast<std::size_t>(corners[2])]};
}

void build_boundary(TetMesh& mesh) {
  constexpr std::size_t kVertices = 4096;
  using Facet = std::pair<Triangle, std::array<Region, 2>>;
  const FaceBuckets faces(mesh);
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<Facet>& found) {
    std::vector<BucketEntry> bucket;
    for (std::size_t v = begin; v < end; ++v) {
      for_each_boundary_face(mesh, faces.of(v), bucket, [&](std::uint32_t code, const std::array<Region, 2>& regions) {
        Triangle facet = face_of(mesh, code);
        if (negative(mesh, mesh.tets[code / 4])) std::swap(facet[1], facet[2]);
        std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
        found.emplace_back(facet, regions);
      });
    }
  };
  mesh.boundary_facets.clear();
  mesh.facet_regions.clear();
  for (const auto& [facet, regions] : parallel_collect<Facet>(mesh.vertices.size(), kVertices, find)) {
    mesh.boundary_facets.push_back(facet);
    mesh.facet_regions.push_back(regions);
  }
  set_strata(mesh);
}

std::vector<std::uint8_t> vertices_of_boundary(const TetMesh& mesh) {
  std::vector<std::uint8_t> flags(mesh.vertices.size(), 0);
  for (const Triangle& facet : mesh.boundary_facets) {
    for (VertexId v : facet) flags[v] = 1;
  }
  for (const auto& nodes : mesh.tet_edge_vertices) {
    for (const VertexId v : nodes) flags[v] = mesh.on_boundary(v) ? 1 : 0;
  }
  return flags;
}

namespace {

constexpr TetFace kNoFace{0, 4};

/// side: 0 for the tets behind facets, 1 for those in front.
std::vector<TetFace> faces_beside_facets(const TetMesh& mesh, std::size_t side) {
  // Only faces whose vertices all are on facets need be looked at: few of all.
  std::vector<std::uint8_t> is_of_facet(mesh.vertices.size(), 0);
  for (const Triangle& facet : mesh.boundary_facets) {
    for (const VertexId v : facet) {
      if (v < is_of_facet.size()) is_of_facet[v] = 1;
    }
  }
  using CodedFace = std::pair<Triangle, std::uint32_t>;  // vertex ids ascending; code, or the index of the facet
  constexpr std::size_t kTets = 16384;
  auto faces = parallel_collect<CodedFace>(mesh.tets.size(), kTets, [&](std::size_t begin, std::size_t end, auto& out) {
    for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
      const Tet& t = mesh.tets[i];
      const int count = is_of_facet[t[0]] + is_of_facet[t[1]] + is_of_facet[t[2]] + is_of_facet[t[3]];
      for (std::uint32_t f = 0; f < 4 && count >= 3; ++f) {
        if (count - is_of_facet[t[f]] == 3) out.push_back({sorted(face_of(mesh, 4 * i + f)), 4 * i + f});
      }
    }
  });
  parallel_sort(faces, std::less<>());
  std::vector<CodedFace> wanted;
  wanted.reserve(mesh.boundary_facets.size());
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    wanted.emplace_back(sorted(mesh.boundary_facets[i]), static_cast<std::uint32_t>(i));
  }
  parallel_sort(wanted, std::less<>());
  std::vector<TetFace> beside(mesh.boundary_facets.size(), kNoFace);
  auto next = faces.begin();
  for (const auto& [facet, index] : wanted) {
    const Region region = mesh.facet_regions[index][side];
    while (next != faces.end() && next->first < facet) ++next;
    for (auto face = next; face != faces.end() && face->first == facet; ++face) {
      if (mesh.tet_regions[face->second / 4] != region) continue;
      beside[index] = decode(face->second);
      break;
    }
  }
  for (std::size_t i = 0; i < beside.size(); ++i) {
    if (beside[i].face < 4 || mesh.facet_regions[i][side] == kOutside) continue;
    const Triangle& facet = mesh.boundary_facets[i];
    throw Error(Fault::internal, "mesh.facet",
                "boundary facet " + std::to_string(i) + " (vertices " + std::to_string(facet[0]) + ", " +
                    std::to_string(facet[1]) + ", " + std::to_string(facet[2]) + ") is not a face of a tet of region " +
                    std::to_string(mesh.facet_regions[i][side]),
                "rebuild the boundary from the tets");
  }
  return beside;
}

}  // namespace

std::vector<TetFace> faces_behind_facets(const TetMesh& mesh) {
  return faces_beside_facets(mesh, 0);
}

std::vector<TetFace> faces_before_facets(const TetMesh& mesh) {
  return faces_beside_facets(mesh, 1);
}

}  // namespace scantet
