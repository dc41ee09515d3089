// Points to triangulate, and what must hold of every triangulation.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "scantet/delaunay/bulk_insertion_impl.h"
#include "scantet/delaunay/inserter_impl.h"
#include "scantet/delaunay/predicates_impl.h"
#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

inline Progress silent;

using Corners = std::array<Point, 4>;

struct LexicographicallyLess {
  bool operator()(const Corners& a, const Corners& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), lexicographically_less);
  }
};
using Tets = std::set<Corners, LexicographicallyLess>;

inline Corners sorted(Corners tet) {
  std::sort(tet.begin(), tet.end(), lexicographically_less);
  return tet;
}

/// In a cube with a corner at the origin.
inline std::vector<SamplePoint> random_points(std::size_t count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(0, size);
  std::vector<SamplePoint> points(count);
  for (SamplePoint& p : points) p.point = {coordinate(random), coordinate(random), coordinate(random)};
  return points;
}

/// A cubic lattice: every eight points that are neighbours lie on one sphere.
inline std::vector<SamplePoint> cubic_lattice(int side) {
  std::vector<SamplePoint> points;
  for (int i = 0; i < side * side * side; ++i) {
    points.push_back({{double(i % side), double(i / side % side), double(i / side / side)}, 3});
  }
  return points;
}

inline Box bounds_of(const std::vector<SamplePoint>& points) {
  Box box;
  for (const SamplePoint& p : points) box.extend(p.point);
  box.extend(box.min - Vec{1, 1, 1});
  box.extend(box.max + Vec{1, 1, 1});
  return box;
}

/// The tets without a far corner.
inline Tets tets_of(const Triangulation& t) {
  Tets tets;
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (t.is_cell(c) && !t.has_corner(c)) tets.insert(sorted(t.points_of(c)));
  }
  return tets;
}

/// Everything but the points.
inline std::vector<std::uint32_t> numbers_of(const Triangulation& t) {
  std::vector<std::uint32_t> all;
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (!t.is_cell(c)) continue;
    all.push_back(c);
    all.insert(all.end(), t.cell(c).vertex.begin(), t.cell(c).vertex.end());
    all.insert(all.end(), t.cell(c).neighbor.begin(), t.cell(c).neighbor.end());
  }
  return all;
}

/// Neighbours know each other, tets are positive, no vertex across a facet is inside a tet's sphere; cells are as many
/// as Euler's formula asks for.
inline void expect_valid(const Triangulation& t) {
  std::size_t faults = 0;
  std::size_t cells = 0;
  std::size_t facets = 0;
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (!t.is_cell(c)) continue;
    ++cells;
    const Corners p = t.points_of(c);
    faults += exact_orientation(p[0], p[1], p[2], p[3]) > 0 ? 0 : 1;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const FacetCode across = t.cell(c).neighbor[i];
      facets += across == kNone || across > 4 * c + i ? 1 : 0;
      if (across == kNone) continue;
      faults += t.cell(across / 4).neighbor[across % 4] == 4 * c + i ? 0 : 1;
      const PointId beyond = t.cell(across / 4).vertex[across % 4];
      if (beyond >= Triangulation::kCorners) faults += t.in_conflict(c, t.point(beyond)) ? 1 : 0;
    }
  }
  EXPECT_EQ(faults, 0U);
  EXPECT_EQ(2 * facets, 4 * cells + 4) << "only the tet of the corners has facets with one side";
  for (PointId v = Triangulation::kCorners; v < t.vertex_slots(); ++v) {
    if (!t.is_vertex(v)) continue;
    const auto& around = t.cell(t.vertex(v).cell).vertex;
    EXPECT_NE(std::find(around.begin(), around.end(), v), around.end());
  }
}

/// Inserts the points in the order given.
inline Triangulation inserted_one_by_one(const std::vector<SamplePoint>& points) {
  Triangulation t(bounds_of(points));
  Inserter inserter(t);
  ConflictZone zone;
  for (const SamplePoint& p : points) {
    if (inserter.find_zone(p.point, kNone, zone) != Inserter::Found::zone) continue;
    const PointId v = inserter.take_vertex();
    t.vertex(v) = {.point = p.point};
    inserter.insert(v, zone);
    t.find_spheres(inserter.new_cells());
  }
  inserter.retire();
  return t;
}

}  // namespace scantet::engine
