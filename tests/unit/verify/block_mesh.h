// Meshes of cubes.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "scantet/base/tet_mesh.h"

namespace scantet::verify {

/// A cube in n³ smaller ones of six tets, but for those whose places, counted from 0, are holes.
inline void add_block(TetMesh& mesh, const Point& least, double side, int n,
                      const std::vector<std::array<int, 3>>& holes = {}) {
  const auto base = static_cast<VertexId>(mesh.vertices.size());
  const auto number = [&](int i, int j, int k) {
    return base + static_cast<VertexId>((k * (n + 1) + j) * (n + 1) + i);
  };
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) mesh.vertices.push_back(least + (side / n) * Point{double(i), double(j), double(k)});
    }
  }
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        if (std::find(holes.begin(), holes.end(), std::array<int, 3>{i, j, k}) != holes.end()) continue;
        for (std::array<int, 3> order{0, 1, 2}; const bool is_even : {true, false, false, true, true, false}) {
          std::array<int, 3> p{i, j, k};
          Tet tet{number(i, j, k), 0, 0, 0};
          for (std::size_t step = 0; step < 3; ++step) {
            ++p[static_cast<std::size_t>(order[step])];
            tet[step + 1] = number(p[0], p[1], p[2]);
          }
          if (!is_even) std::swap(tet[2], tet[3]);
          mesh.tets.push_back(tet);
          std::next_permutation(order.begin(), order.end());
        }
      }
    }
  }
  mesh.tet_regions.assign(mesh.tets.size(), 1);
}

}  // namespace scantet::verify
