// Voxels are looked at layer by layer, with the tets whose boxes reach the layer.
#include "scantet/verify/label_mesh.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "scantet/base/parallel.h"
#include "scantet/base/union_find.h"
#include "scantet/verify/exact_sign.h"
#include "scantet/verify/voxel_nodes.h"

namespace scantet::verify {
namespace {

struct Face {
  std::array<VertexId, 3> key;  // ascending
  std::uint32_t tet;
  friend bool operator<(const Face& a, const Face& b) { return std::tie(a.key, a.tet) < std::tie(b.key, b.tet); }
};

std::vector<Face> faces_of(const TetMesh& mesh) {
  std::vector<Face> faces(4 * mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      Face& face = faces[4 * t + left_out];
      face.tet = static_cast<std::uint32_t>(t);
      for (std::size_t n = 0; n < 3; ++n) face.key[n] = mesh.tets[t][(left_out + 1 + n) % 4];
      std::sort(face.key.begin(), face.key.end());
    }
  }
  parallel_sort(faces, std::less<>());
  return faces;
}

/// Voxels whose centres may be in a tet: from, to. Empty if from > to along an axis.
struct Span {
  std::array<int, 3> from;
  std::array<int, 3> to;
};

Span span_of(const TetMesh& mesh, const Tet& tet, const IndexMap& map, const std::array<int, 3>& size) {
  Box box;
  for (const VertexId v : tet) extend(box, map.to_index(mesh.vertices[v]));
  constexpr double kMargin = 1e-6;  // centres are rounded
  Span span{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    span.from[a] = static_cast<int>(std::clamp(std::ceil(box.min[axis] - kMargin), 0.0, double(size[a])));
    span.to[a] = static_cast<int>(std::clamp(std::floor(box.max[axis] + kMargin), -1.0, size[a] - 1.0));
  }
  return span;
}

/// 1: strictly inside, 0: on the boundary, -1: outside. For tets of either sign.
int side_of(const TetMesh& mesh, const Tet& tet, const Point& p) {
  int least = 1;
  int most = -1;
  for (std::size_t n = 0; n < 4; ++n) {
    std::array<Point, 4> corners;
    for (std::size_t c = 0; c < 4; ++c) corners[c] = c == n ? p : mesh.vertices[tet[c]];
    const int turn = orientation(corners[0], corners[1], corners[2], corners[3]);
    least = std::min(least, turn);
    most = std::max(most, turn);
    if (least < 0 && most > 0) return -1;
  }
  return least > 0 || most < 0 ? 1 : 0;
}

}  // namespace

MeshRegions mesh_regions(const TetMesh& mesh) {
  MeshRegions all;
  UnionFind tets(mesh.tets.size());
  const std::vector<Face> faces = faces_of(mesh);
  for (std::size_t begin = 0, end; begin < faces.size(); begin = end) {
    end = begin + 1;
    while (end < faces.size() && faces[end].key == faces[begin].key) ++end;
    const Region first = mesh.tet_regions[faces[begin].tet];
    if (end == begin + 1) {
      all.faces.push_back({faces[begin].key, {std::min(first, kOutside), std::max(first, kOutside)}});
    }
    for (std::size_t n = begin + 1; n < end; ++n) {
      const Region other = mesh.tet_regions[faces[n].tet];
      if (other == first) {
        tets.unite(faces[begin].tet, faces[n].tet);
      } else {
        all.faces.push_back({faces[begin].key, {std::min(first, other), std::max(first, other)}});
      }
    }
  }
  all.parts.resize(tets.number_sets(all.part_of));
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) all.parts[all.part_of[t]] = mesh.tet_regions[t];
  return all;
}

std::vector<VoxelPlace> voxel_places(const TetMesh& mesh, const LabelSource& labels, const Progress& progress) {
  const std::array<int, 3>& size = labels.size();
  const IndexMap map(labels.frame());
  std::vector<Span> spans(mesh.tets.size());
  parallel_for(spans.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) spans[t] = span_of(mesh, mesh.tets[t], map, size);
  });
  std::vector<std::vector<std::uint32_t>> of_layer(static_cast<std::size_t>(size[2]));
  for (std::uint32_t t = 0; t < spans.size(); ++t) {
    const Span& s = spans[t];
    if (s.from[0] > s.to[0] || s.from[1] > s.to[1]) continue;
    for (int k = s.from[2]; k <= s.to[2]; ++k) of_layer[static_cast<std::size_t>(k)].push_back(t);
  }
  const auto row = static_cast<std::size_t>(size[0]);
  const std::size_t layer = row * static_cast<std::size_t>(size[1]);
  std::vector<VoxelPlace> places(layer * of_layer.size());
  const auto look = [&](std::uint32_t t, int i, int j, int k) {
    const Point p = labels.frame().to_world({double(i), double(j), double(k)});
    const int side = side_of(mesh, mesh.tets[t], p);
    if (side < 0) return;
    VoxelPlace& place =
        places[static_cast<std::size_t>(k) * layer + static_cast<std::size_t>(j) * row + static_cast<std::size_t>(i)];
    place.has_label = place.has_label || mesh.tet_regions[t] == labels.region_of(i, j, k);
    if (side == 0 && place.tet != VoxelPlace::kNoTet) return;
    place.tet = t;
    place.is_on_face = side == 0;
  };
  parallel_for(of_layer.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end && !progress.cancelled(); ++k) {
      for (const std::uint32_t t : of_layer[k]) {
        for (int j = spans[t].from[1]; j <= spans[t].to[1]; ++j) {
          for (int i = spans[t].from[0]; i <= spans[t].to[0]; ++i) look(t, i, j, static_cast<int>(k));
        }
      }
    }
  });
  return places;
}

}  // namespace scantet::verify
