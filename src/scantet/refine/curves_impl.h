// Private: the samples of the domain's curves in a triangulation.
#pragma once

#include <vector>

#include "scantet/base/point_grid_impl.h"
#include "scantet/delaunay/bulk_insertion_impl.h"
#include "scantet/refine/extract_impl.h"
#include "scantet/sampling/curve_sample.h"
#include "scantet/sampling/hinted_spacing_impl.h"

namespace scantet::engine {

/// The points with weights, which come first in a triangulation, and what they keep other points off.
class Curves {
 public:
  Curves(const Domain& domain, const SizingField& size, double alpha);

  bool empty() const { return points_.empty(); }
  const std::vector<Point>& points() const { return points_; }
  /// Where one stands for several curves or corners.
  const std::vector<Point>& merged() const { return sample_.merged; }
  std::vector<SamplePoint> weighted_points() const;
  /// What meets at each of them (RestrictedTriangulation::set_junctions), and the pieces between them where all curves
  /// are rims or edges: around those of label maps points to mend them beget others (docs/algorithm.md, "Protection").
  Junctions junctions() const;
  /// The pieces of curves with two regions around them: that these are curves the mesh alone does not tell. domain:
  /// that of the constructor.
  SharpEdges sharp_edges(const Domain& domain) const;

  /// Whether a point is in a ball or close to its centre.
  bool is_near(const Point& p) const;
  /// Drops those that are.
  void drop_near(std::vector<Point>& points) const;

 private:
  CurveSample sample_;
  double apart_mm_;
  double widest_mm_;
  std::vector<Point> points_;
  PointGrid grid_;
  HintedSpacing hinted_;            // by the domain's hints
  std::vector<CurvePiece> pieces_;  // of rims and edges, if all curves are
};

}  // namespace scantet::engine
