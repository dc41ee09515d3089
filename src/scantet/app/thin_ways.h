// Ways to what a mesh has lost of the thin parts of its domain.
#pragma once

#include <span>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet {

/// Segments on one side of the boundary around places of it, points that a mesh is too far from: a mesh with these in
/// tets of their regions (MesherOptions::ways) has what is thin there. near_mm, > 0: how far such a mesh may still be
/// from the places. None of a domain without cells (Domain::boundary_cells()).
std::vector<NarrowWay> ways_to(const Domain& domain, std::span<const Point> places, double near_mm);

}  // namespace scantet
