// What refinement returns, and the two kernels' entry points.
#pragma once

#include <array>
#include <vector>

#include "curve_sample.h"

namespace scantet::bench {

struct RefinementBounds {
  double size_mm = 1;  ///< of surface balls and of tets' circumspheres: radii
  double facet_radius_edge = 1;
  double tet_radius_edge = 2;
  double split_floor = 0.25;  ///< S: segments longer than this many sizes may be split
  int most_vertices = 200000;
};

/// A facet between two regions.
struct InterfaceFacet {
  std::array<int, 3> vertex;
  int patch = 0;
};

struct Refined {
  std::vector<MeshVertex> vertices;
  std::vector<CurveSegment> segments;
  std::vector<std::array<int, 4>> tets;  ///< of the regions other than 0
  std::vector<InterfaceFacet> facets;
  bool capped = false;
  int curve_samples = 0;  ///< before refinement
  int loose = 0;          ///< see CurveSample
  int refused = 0;        ///< of them in the last pass over all elements, which inserts nothing more
  int splits = 0;         ///< curve segments split
  int off_patch = 0;      ///< restricted facets left with a vertex off their patch
  int bad_facets = 0;     ///< left too large or badly shaped
  int bad_tets = 0;
  double seconds = 0;
};

/// With CGAL's Delaunay_triangulation_3 (U, S, C).
Refined refine_delaunay(const Arrangement& domain, Method method, const RefinementBounds& bounds, unsigned seed);
/// With CGAL's Regular_triangulation_3 (W).
Refined refine_regular(const Arrangement& domain, const RefinementBounds& bounds, unsigned seed);

/// Seconds to triangulate the points in that order of insertion; weights are zero.
double delaunay_seconds(const std::vector<Point>& points);
double regular_seconds(const std::vector<Point>& points);
/// Bytes of a cell without anything of the mesher's.
std::size_t delaunay_cell_bytes();
std::size_t regular_cell_bytes();

}  // namespace scantet::bench
