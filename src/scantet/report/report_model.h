// What a report says of what a mesh has for solvers: fields, elements of second order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// A field of a scan that the mesh carries.
struct ReportField {
  std::string name;
  std::string scan;     ///< its path
  std::string measure;  ///< "mean", "fraction=3"
  double min = 0;       ///< of the tets' values, in the scan's unit
  double max = 0;
  double mean = 0;                 ///< by volume
  double total = 0;                ///< the sum of volume times value, in the unit times mm³
  std::uint64_t tets_outside = 0;  ///< that reach beyond the scan
};

/// What became of a mesh on its way to second order, or of one that was read what is known; docs/second_order.md.
struct ReportSecondOrder {
  std::uint64_t edges = 0;                   ///< as many nodes were added
  std::uint64_t boundary_edges = 0;          ///< of boundary facets
  std::optional<std::uint64_t> on_boundary;  ///< of these, with their node on the surface or its curve
  std::optional<std::uint64_t> eased_edges;  ///< taken back toward the straight edge
  std::optional<std::uint64_t> eased_tets;   ///< for whose sake
  std::uint64_t unproved = 0;                ///< tets whose Jacobian is not proved positive
  double least_share = 1;                    ///< bound below every Jacobian, as a share of its straight tet's
  double volume_mm3 = 0;                     ///< of all elements, as they are curved
};

}  // namespace scantet
