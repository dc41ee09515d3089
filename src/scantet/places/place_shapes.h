// Places that points alone tell.
#pragma once

#include "scantet/places/place.h"
#include "scantet/places/scan_values.h"

namespace scantet {

/// How far a point is from being in a place, or, if it is in it, from being out.
struct Hit {
  enum class Unit : std::uint8_t { mm, degrees, value };
  double miss = 0;  ///< >= 0; infinite: no move or turn changes it
  bool is_in = false;
  Unit unit = Unit::mm;  ///< of miss
};

/// Of a box, ball, cylinder, planes or a threshold of a scan (Place::Kind::above, below), which is in `scans`; their
/// borders are in them. p: mm.
Hit hit_of_shape(const Place& place, const ScanTable& scans, const Point& p);

/// What is in both, or in one of the two, or not in one.
Hit hit_of_both(const Hit& a, const Hit& b);
Hit hit_of_either(const Hit& a, const Hit& b);
Hit hit_of_complement(Hit hit);

/// Whether a point is in a place; only for those of which is_of_points() is true.
bool is_point_in(const Place& place, const ScanTable& scans, const Point& p);

}  // namespace scantet
