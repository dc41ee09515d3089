// Distances between a mesh's boundary and a level set where there is no collar, and places that show how far they are.
#pragma once

#include <array>
#include <optional>

#include "scantet/verify/box_tree.h"
#include "scantet/verify/collar.h"

namespace scantet::verify {

/// The square of the distance of p from a point of the triangle, the nearest one to rounding.
double squared_distance_to(const Point& p, const Point& a, const Point& b, const Point& c);

/// Bounds of the field at a place that is known up to rounding; nothing outside of the field's box. If parts were left
/// out: the sign is that of what is left; nothing where that is not known.
std::optional<Interval> field_at(const CollarInput& input, const IntervalVec& place);

/// Whether a boundary vertex is proved to be within `tolerance_mm` of the level set: it lies between both signs.
bool is_near_level(const CollarInput& input, const Collar& collar, std::uint32_t vertex, double tolerance_mm);

/// Distances between the boundary and the level set.
class Distances {
 public:
  /// facets: the boxes of the boundary's facets, mm. All must outlive it.
  Distances(const CollarInput& input, const Collar& collar, const BoxTree& facets);

  /// No point of the facet is farther from the level set, mm; proved. None: not bounded.
  std::optional<double> bound_of_facet(std::size_t facet) const;
  /// No point of the level set is farther from the boundary; `aim_mm`: what is small enough. place: where it is so far.
  double bound_of_level(double aim_mm, const Progress& progress, Point& place) const;
  /// How far a point of the facet, the farthest of some, is from the level set at least, and the point.
  double at_least(std::size_t facet, Point& place) const;
  /// How far a point of the level set on the same fibre is from the boundary at least, and that point.
  double level_at_least(std::size_t facet, Point& place) const;
  /// The radius (mm) of a ball around a place that is proved to be free of the level set; at most `limit`.
  double free_radius(const IntervalVec& place, double limit) const;

 private:
  /// Or any distance of a point of the boundary that is at most `enough`.
  double distance_to_boundary(const Point& p, double enough) const;
  double level_in_box(const CellValues& values, const Cell& cell, const Box& box, double aim, int depth,
                      Point& place) const;
  /// Of a place where the field is zero to rounding: it has both signs beside it.
  std::optional<double> bound_on_level(const Vec& place, const Vec& along) const;
  /// The level set lies between a place and a voxel's centre on the other side of the level.
  std::optional<double> bound_by_node(const Vec& place) const;
  std::optional<double> bound_at(const Vec& place, const Vec& along, double limit) const;
  struct Sample {
    Vec place;
    Vec along;
    double off = 0;
  };
  Sample farthest_sample(std::size_t facet) const;

  const CollarInput& in_;
  const Collar& collar_;
  const BoxTree& tree_;  // of facets, world
  double margin_mm_;     // of a distance, by rounding
  std::array<double, 3> spacing_;
  double skew_;                // squares of lengths are at least this share of what they are with axes at right angles
  double cell_radius_mm_ = 0;  // no point of a cell is farther from its middle
};

}  // namespace scantet::verify
