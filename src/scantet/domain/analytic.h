// Domains with known volume and topology, for tests and examples.
#pragma once

#include <memory>

#include "scantet/base/api.h"
#include "scantet/domain/domain.h"

namespace SCANTET_API scantet {

/// A ball. radius_mm > 0, which nothing checks, nor the conditions below.
std::unique_ptr<Domain> make_sphere(const Point& center, double radius_mm);

/// The points between two concentric spheres: one component with a cavity. 0 < inner_mm < outer_mm.
std::unique_ptr<Domain> make_shell(const Point& center, double inner_mm, double outer_mm);

/// A solid torus around the z axis through the centre. 0 < tube_mm < ring_mm.
std::unique_ptr<Domain> make_torus(const Point& center, double ring_mm, double tube_mm);

/// The quartic of genus five x⁴ − 5x² + y⁴ − 5y² + z⁴ − 5z² + 11.8 < 0 (the paper's Figure 7) around the origin, 1 mm a
/// unit. It does not tell its components.
std::unique_ptr<Domain> make_tanglecube();

/// Two balls of one radius with a gap between them: two components, on the x axis on either side of the origin.
/// radius_mm > 0, gap_mm > 0.
std::unique_ptr<Domain> make_two_spheres(double radius_mm, double gap_mm);

}  // namespace scantet
