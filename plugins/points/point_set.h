// Points with normals, as CGAL's algorithms take them.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/property_map.h>

#include <string>
#include <utility>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/base/geometry.h"

namespace points {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A point, mm, and its normal; the zero vector where there is none.
using Oriented = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using PointMap = CGAL::First_of_pair_property_map<Oriented>;
using NormalMap = CGAL::Second_of_pair_property_map<Oriented>;
using PointSet = std::vector<Oriented>;

inline scantet::Point place_of(const Oriented& point) {
  return {point.first.x(), point.first.y(), point.first.z()};
}
inline scantet::Vec normal_of(const Oriented& point) {
  return {point.second.x(), point.second.y(), point.second.z()};
}

/// Ends with an Error of the data: input.points.
[[noreturn]] inline void refuse(const std::string& file, const std::string& what, const std::string& remedy) {
  throw scantet::Error(scantet::Fault::input, "input.points", file + ": " + what, remedy);
}

}  // namespace points
