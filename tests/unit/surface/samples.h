// Samples of boundaries, and their restricted triangulations.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "scantet/surface/boundary_link_impl.h"
#include "scantet/surface/restricted_triangulation_impl.h"

namespace scantet::engine {

/// One in so many of the candidates: a sample so sparse that parts of the domain come apart.
inline std::vector<SamplePoint> sparse_sample(const Domain& domain, double spacing_mm, std::size_t one_in) {
  std::vector<SamplePoint> sample;
  std::size_t count = 0;
  domain.surface_candidates(spacing_mm, [&](const Point& p) {
    if (count++ % one_in == 0) sample.push_back({p, 2});
  });
  return sample;
}

/// Of a dumbbell (solids.h): points on and in the balls, and none on the neck, so that its mesh comes in two pieces.
inline std::vector<SamplePoint> without_neck(const Domain& dumbbell) {
  std::vector<SamplePoint> sample = sparse_sample(dumbbell, 0.8, 1);
  std::erase_if(sample, [](const SamplePoint& p) { return p.point.x > -1.9 && p.point.x < 2.1; });
  for (const double x : {-5.1, 4.9}) {
    for (int i = 0; i < 343; ++i) {
      const Vec off{0.81 * (i % 7 - 3), 0.83 * (i / 7 % 7 - 3), 0.79 * (i / 49 - 3)};
      if (length(off) < 2.4) sample.push_back({Point{x, 0.1, 0.1} + off, 3});
    }
  }
  return sample;
}

inline RestrictedTriangulation triangulated(const Domain& domain, std::vector<SamplePoint> sample) {
  RestrictedTriangulation t(domain);
  Progress progress;
  EXPECT_TRUE(t.build(std::move(sample), progress));
  return t;
}

/// Whether a point is in a cell without a corner of the hull, or on its faces: by the signs of volumes alone.
inline bool holds(const Triangulation& t, CellId cell, const Point& p) {
  const std::array<Point, 4> v = t.points_of(cell);
  return orientation_mm3(p, v[1], v[2], v[3]) >= 0 && orientation_mm3(v[0], p, v[2], v[3]) >= 0 &&
         orientation_mm3(v[0], v[1], p, v[3]) >= 0 && orientation_mm3(v[0], v[1], v[2], p) >= 0;
}

/// Inserts a point of the boundary wherever it lies; nothing if it is a vertex.
inline void insert(RestrictedTriangulation& t, const Point& p) {
  Editor editor(t);
  if (editor.find_zone(p, kNone) == Inserter::Found::zone) editor.insert({p, 2});
  editor.retire();
}

/// Tets of one region, with their middles there, get to the other side.
inline void turn(RestrictedTriangulation& restricted, Region from, const std::function<bool(const Point&)>& is_there) {
  const Triangulation& t = restricted.triangulation();
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (!t.is_cell(c) || t.has_corner(c) || t.info(c).region != from) continue;
    const auto p = t.points_of(c);
    if (is_there(p[0] + 0.25 * ((p[1] - p[0]) + (p[2] - p[0]) + (p[3] - p[0])))) restricted.change_side(c, 1 - from);
  }
}

/// Calls visit(code) for each facet that two cells share, as the first of them sees it.
template <class Visit>
void for_each_inner_facet(const Triangulation& t, Visit visit) {
  for (CellId c = 0; c < t.cell_slots(); ++c) {
    if (!t.is_cell(c)) continue;
    for (FacetCode facet = 4 * c; facet < 4 * c + 4; ++facet) {
      const FacetCode across = t.cell(c).neighbor[facet % 4];
      if (across != kNone && facet < across) visit(facet);
    }
  }
}

/// Facets with their vertices, and no patches.
inline BoundaryFacets with_corners(const Triangulation& t, std::vector<FacetCode> codes) {
  BoundaryFacets facets;
  facets.codes = std::move(codes);
  for (const FacetCode f : facets.codes) facets.corners.push_back(facet_vertices(t.cell(f / 4), int(f % 4)));
  return facets;
}

/// What check_disks() says of all vertices on ∂O that are not known to have a disk.
inline std::vector<PointId> check_all_disks(const Triangulation& t, DiskNotes& notes,
                                            const std::function<std::vector<FacetCode>()>& facets) {
  std::vector<PointId> vertices;
  for (PointId v = 0; v < t.vertex_slots(); ++v) {
    if (t.is_vertex(v) && t.vertex_info(v).on_boundary() && !notes.has_disk(v)) vertices.push_back(v);
  }
  BoundaryFacets all;
  return check_disks(t, notes, {}, vertices,
                     [&]() -> const BoundaryFacets& { return all = with_corners(t, facets()); });
}

}  // namespace scantet::engine
