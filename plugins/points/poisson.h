// Poisson reconstruction: a function of space that is negative inside the surface through oriented points.
#pragma once

#include <memory>

#include "level_grid.h"
#include "point_set.h"
#include "scantet/base/progress.h"

namespace points {

/// The mean distance of a point to the nearest ones (the six nearest, as CGAL counts them), mm.
double average_spacing_mm(const PointSet& points);

/// CGAL's Poisson reconstruction function: the solution of a Poisson equation, linear on each tet of a Delaunay
/// triangulation of the points and of further ones, which fill the space to one diagonal of their box around its
/// centre. Source: Kazhdan, Bolitho, Hoppe, Poisson surface reconstruction (2006).
class Poisson {
 public:
  /// points: with normals of length 1 that point outwards. The outcome does not depend on the unit of length.
  /// Throws scantet::Error: input.points (no solution).
  Poisson(const std::string& file, const PointSet& points, double spacing_mm);
  ~Poisson();

  /// Fills in the values at the grid's nodes; the same for any number of threads. Stops early if cancelled.
  void sample(LevelGrid& grid, scantet::Progress& progress) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace points
