// A domain cut by planes.
#pragma once

#include <memory>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/cuts/cut_plane.h"
#include "scantet/domain/domain.h"

namespace SCANTET_API scantet {

/// What the cutting of a domain has found.
struct CutReport {
  std::vector<bool> meets;    ///< for each plane, whether it meets what the others leave of the object
  std::size_t unsettled = 0;  ///< points where rims meet, but no curve of the domain that comes there
  std::size_t uncounted = 0;  ///< components and cavities that a plane may cut: it is not known what is left of these
  std::size_t counted = 0;    ///< those that are whole, and known
};

/// What planes leave of a domain: the points of its regions that are beyond none of them. Each plane's part of the
/// boundary, its cap, is a patch with the plane's name; its rims, and the edges where two caps meet, are curves, whose
/// vertices are sharp in the mesh. The domain's own curves end at the planes, in corners.
///
/// Rims are looked for in each plane by the lines of a grid, step_mm apart: every part of a region in the plane that is
/// wider is found. All crossings on a plane are on it to a rounding error. A plane that a face, an edge or a corner of
/// the domain lies in is moved inwards by 1e-10 of the domain's size (or distance from the origin), off what would meet
/// it there by chance of rounding; not one of a border.
///
/// What the domain says of itself is kept as far as it still holds: components, with their Euler numbers, if no plane
/// but the border's meets one, and the regions are one (otherwise those that are whole, known_components()); size hints
/// and narrow ways where nothing is cut off. Distances are sampled, not bounded (boundary_cells()).
///
/// domain: any, not null. planes: at least one. step_mm: > 0. spacing_mm: > 0, the largest step of the domain's own
/// grid, if it has one, else step_mm. report: is overwritten; null: not wanted. Return: owns the domain that was given.
/// Throws Error: input.cut (nothing is left).
std::unique_ptr<Domain> make_cut_domain(std::unique_ptr<Domain> domain, std::vector<CutPlane> planes, double step_mm,
                                        double spacing_mm, CutReport* report = nullptr);

/// Throws the error of make_cut_domain(), input.cut.
[[noreturn]] void refuse_cuts();

}  // namespace scantet
