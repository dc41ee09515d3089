// How many vertices a mesh will have, roughly, before there is one.
#pragma once

#include <vector>

#include "scantet/domain/cone_tree.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

/// Vertices of a mesh of one size, mm, > 0: one for each cube of the size. Where the domain does not know its volume, a
/// twentieth of its bounding box stands for it. Measured: skull.nrrd has 139,000 for a volume of 155,000 cubes.
double vertices_of_size(const Domain& domain, double size_mm);

/// Vertices inside, where sizes vary: one for each cube of the size there, looked at on 40 x 40 x 40 points of the
/// bounding box.
double vertices_inside(const Domain& domain, const SizingField& size);

/// Vertices on the boundary: each of these points stands for a square of apart_mm a side, with a vertex for each square
/// of the size there.
double vertices_on_boundary(const std::vector<Cone>& sizes, double apart_mm);

}  // namespace scantet
