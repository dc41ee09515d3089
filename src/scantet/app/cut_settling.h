// Settling what planes leave of an object.
#pragma once

#include <functional>
#include <vector>

#include "scantet/cuts/cut_plane.h"
#include "scantet/plugin/input_plugin.h"

namespace scantet {

/// How an object is cut: what make_cut_domain() is told.
struct Cutting {
  std::vector<CutPlane> planes;
  double step_mm = 0;
  double spacing_mm = 0;
};

/// Settles what planes leave of an object (OpenedDomain::settle). Its curves stay, rims among them, and regions that a
/// plane comes near, of which nobody knows what volume should be left, are moved for the sake of others alone.
/// whole: settles the object. cut, grid: what is left of it, and of its grid.
Settling settling_of_cut(Settling whole, const Domain& cut, std::function<RegionGrid()> grid, const Cutting& cutting);

}  // namespace scantet
