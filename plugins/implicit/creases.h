// Where smooth parts of a formula's surface meet at an angle.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/domain/curve.h"

namespace implicit {

struct Creases {
  std::vector<std::shared_ptr<const scantet::Curve>> curves;  ///< between the inside and the outside
  std::vector<scantet::Corner> corners;                       ///< that the curves' ends refer to
};

/// The edges of the object at which the directions that two smooth parts of its surface face differ by `degrees` or
/// more somewhere, and the corners where three parts meet. Edges are looked for on a lattice of 64 cells along each
/// axis of the box, so that those much shorter than a cell are missed; their points are then found to the last digits.
/// Always in the same order. Throws scantet::Error (input.formula): as SignTree. Empty if progress.cancelled() became
/// true.
Creases find_creases(const std::string& formula, const scantet::Box& box, double degrees,
                     const scantet::Progress& progress = scantet::Progress());

}  // namespace implicit
