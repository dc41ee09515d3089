// Surfaces as text, for tests to write and to spoil.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace scantet {

struct Facets {
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<int>> polygons;

  /// Adds a cube of six quadrangles around `centre` that reaches `half` each way.
  void add_cube(const std::array<double, 3>& centre, double half) {
    const int base = static_cast<int>(points.size());
    for (int i = 0; i < 8; ++i) {
      points.push_back(
          {centre[0] + (i & 1 ? half : -half), centre[1] + (i & 2 ? half : -half), centre[2] + (i & 4 ? half : -half)});
    }
    const std::vector<std::vector<int>> sides{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                              {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (std::vector<int> side : sides) {
      for (int& vertex : side) vertex += base;
      polygons.push_back(side);
    }
  }

  /// Adds a cube whose sides are cut into n x n quadrangles.
  void add_fine_cube(const std::array<double, 3>& centre, double half, int n) {
    const auto at = [&](int axis, int side, int i, int j) {
      std::array<double, 3> p = centre;
      p[axis] += side * half;
      p[(axis + 1) % 3] += half * (2.0 * i / n - 1);
      p[(axis + 2) % 3] += half * (2.0 * j / n - 1);
      points.push_back(p);
      return static_cast<int>(points.size()) - 1;
    };
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        for (int i = 0; i < n; ++i) {
          for (int j = 0; j < n; ++j) {
            polygons.push_back({at(axis, side, i, j), at(axis, side, i + 1, j), at(axis, side, i + 1, j + 1),
                                at(axis, side, i, j + 1)});
          }
        }
      }
    }
  }

  /// Adds a torus of 1,600 triangles around the z axis.
  void add_ring(double ring, double tube) {
    constexpr int kAround = 40;
    constexpr int kTube = 20;
    const int base = static_cast<int>(points.size());
    const auto id = [&](int a, int b) { return base + a % kAround * kTube + b % kTube; };
    for (int i = 0; i < kAround; ++i) {
      for (int j = 0; j < kTube; ++j) {
        const double u = 2 * M_PI * i / kAround;
        const double v = 2 * M_PI * j / kTube;
        const double out = ring + tube * std::cos(v);
        points.push_back({out * std::cos(u), out * std::sin(u), tube * std::sin(v)});
        polygons.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
        polygons.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
      }
    }
  }

  std::string off() const {
    std::string text =
        "OFF\n" + std::to_string(points.size()) + " " + std::to_string(polygons.size()) + " 0\n" + lines("");
    for (const auto& polygon : polygons) {
      text += std::to_string(polygon.size());
      for (const int vertex : polygon) text += " " + std::to_string(vertex);
      text += "\n";
    }
    return text;
  }
  std::string obj() const {
    std::string text = lines("v ");
    for (const auto& polygon : polygons) {
      text += "f";
      for (const int vertex : polygon) text += " " + std::to_string(vertex + 1);
      text += "\n";
    }
    return text;
  }
  std::string ply() const {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points.size()) +
                       "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                       std::to_string(polygons.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string rest = off();
    return text + rest.substr(rest.find('\n', rest.find('\n') + 1) + 1);
  }
  /// Each polygon as a fan of triangles.
  std::string stl() const {
    std::string text = "solid test\n";
    for (const auto& polygon : polygons) {
      for (std::size_t i = 2; i < polygon.size(); ++i) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const int vertex : {polygon[0], polygon[i - 1], polygon[i]}) text += "vertex " + line(points[vertex]);
        text += "endloop\nendfacet\n";
      }
    }
    return text + "endsolid test\n";
  }

 private:
  static std::string line(const std::array<double, 3>& p) {
    return std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  }
  std::string lines(const std::string& start) const {
    std::string text;
    for (const auto& p : points) text += start + line(p);
    return text;
  }
};

inline Facets ring() {
  Facets facets;
  facets.add_ring(3, 1);
  return facets;
}

inline Facets cube(double half) {
  Facets facets;
  facets.add_cube({0, 0, 0}, half);
  return facets;
}

/// A cube with a cubic cavity, and a second cube beside it.
inline Facets cubes() {
  Facets facets = cube(2);
  facets.add_cube({0.1, 0, 0}, 1);
  facets.add_cube({6, 1, 0}, 1.5);
  return facets;
}

}  // namespace scantet
