#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <stdexcept>

#include "contestants.h"

namespace scantet::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

std::vector<Kernel::Point_3> read_points(std::FILE* file) {
  std::vector<Kernel::Point_3> points;
  std::rewind(file);
  for (Point p; std::fread(&p, sizeof p, 1, file) == 1;) points.emplace_back(p.x, p.y, p.z);
  if (points.empty()) throw std::runtime_error("no points: scantet has to run before the limit");
  return points;
}

}  // namespace

Figures run_limit(std::FILE* file) {
  Figures figures;
  const std::vector<Kernel::Point_3> points = read_points(file);
  const Meter meter;
  const CGAL::Delaunay_triangulation_3<Kernel> triangulation(points.begin(), points.end());
  meter.read(figures);
  figures.vertices = triangulation.number_of_vertices();
  figures.tets = triangulation.number_of_finite_cells();
  return figures;
}

}  // namespace scantet::bench
