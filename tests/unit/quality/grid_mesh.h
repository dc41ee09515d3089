// Meshes for tests: cubes of a grid, each cut into six tets (Kuhn), which fit together across cubes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/tet_mesh.h"

namespace scantet::test {

/// The region of the cube with these indices; kOutside leaves it out.
using CubeRegion = std::function<Region(int, int, int)>;

inline Region everywhere(int, int, int) {
  return 1;
}

/// n³ cubes of side 1 from the origin, with consistent boundary and no unused vertex.
inline TetMesh grid_mesh(int n, const CubeRegion& region_of = everywhere) {
  const auto node = [n](const std::array<int, 3>& i) {
    return static_cast<VertexId>(i[0] + (n + 1) * (i[1] + (n + 1) * i[2]));
  };
  TetMesh mesh;
  std::vector<VertexId> number(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)), 0xffffffff);
  const auto vertex = [&](const std::array<int, 3>& i) {
    VertexId& id = number[node(i)];
    if (id == 0xffffffff) {
      id = static_cast<VertexId>(mesh.vertices.size());
      mesh.vertices.push_back({static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2])});
    }
    return id;
  };
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const Region region = region_of(i, j, k);
        if (region == kOutside) continue;
        std::array<int, 3> axes{0, 1, 2};
        do {
          std::array<int, 3> corner{i, j, k};
          Tet tet{};
          tet[0] = vertex(corner);
          for (std::size_t step = 0; step < 3; ++step) {
            ++corner[static_cast<std::size_t>(axes[step])];
            tet[step + 1] = vertex(corner);
          }
          const auto at = [&](std::size_t c) { return mesh.vertices[tet[c]]; };
          if (orientation_mm3(at(0), at(1), at(2), at(3)) < 0) std::swap(tet[2], tet[3]);
          mesh.tets.push_back(tet);
          mesh.tet_regions.push_back(region);
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
    }
  }
  build_boundary(mesh);
  return mesh;
}

/// A grid of n³ cubes (n even) bent into a ball: nodes at depth d of the cube lie on the sphere of radius radius_of(d),
/// where d runs from 0 (the centre) to n / 2.
inline TetMesh bent_grid(int n, const Point& center, const std::function<double(double)>& radius_of,
                         const CubeRegion& region_of = everywhere) {
  TetMesh mesh = grid_mesh(n, region_of);
  for (Point& p : mesh.vertices) {
    const Vec d = p - Point{0.5 * n, 0.5 * n, 0.5 * n};
    const double depth = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    p = depth == 0 ? center : center + (radius_of(depth) / length(d)) * d;
  }
  return mesh;
}

inline TetMesh ball_mesh(int n, const Point& center, double radius_mm, const CubeRegion& region_of = everywhere) {
  return bent_grid(
      n, center, [=](double depth) { return radius_mm * depth / (0.5 * n); }, region_of);
}

/// The first tet of the cube (i, j, k) of a full grid.
inline std::size_t tet_in_cube(int n, int i, int j, int k) {
  const int tet = 6 * (i + n * (j + n * k));
  return static_cast<std::size_t>(tet);
}

}  // namespace scantet::test
