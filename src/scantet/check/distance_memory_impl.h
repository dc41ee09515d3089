// Private to check/: what measuring one mesh tells of the next.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/check/distance_impl.h"

namespace scantet::measuring {

/// What was proved of a surface's cells and facets. A facet's bound holds for the same facet of another mesh; a cell's
/// as long as all facets are there that were near it, for others can only be nearer.
class SurfaceMemory {
 public:
  /// To be called before a mesh is measured. facets: of it, those that stand for the surface. limit_mm: the same
  /// each time; without one no bounds of cells are kept.
  void begin(const TetMesh& mesh, const std::vector<std::uint32_t>& facets, std::optional<double> limit_mm);

  /// A bound that still holds of the cell with that place in a group, and that center and half diagonal, mm; none if
  /// none is known.
  std::optional<double> of_cell(std::size_t group, std::size_t place, const Point& center,
                                double half_diagonal_mm) const;
  /// The bounds of a group's cells: as many as it has.
  void keep_cells(std::size_t group, std::vector<double> upper_mm) { cells_mm_[group] = std::move(upper_mm); }
  /// groups: that the surface's cells are in.
  void make_room(std::size_t groups) { cells_mm_.resize(groups); }

  /// What was found of a facet; null if it was not there.
  const PartBounds* of_facet(const FacetCorners& corners) const;
  /// bounds: of the facets that begin() got.
  void keep_facets(std::vector<PartBounds> bounds);

 private:
  struct Known {
    FacetCorners corners;  // in ascending order
    std::uint32_t place;   // in bounds_
  };

  std::vector<Known> next_;  // of the mesh being measured, in ascending order
  std::vector<Known> known_;
  std::vector<PartBounds> bounds_;
  FacetTree gone_;  // facets of the mesh before that are not there any more
  std::optional<double> limit_mm_;
  std::vector<std::vector<double>> cells_mm_;  // by group and cell
};

}  // namespace scantet::measuring
