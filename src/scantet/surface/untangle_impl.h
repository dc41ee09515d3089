// Private: makes the boundary of the mesh a manifold with the domain's components where sampling alone does not.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <unordered_set>

#include "scantet/domain/sizing_field.h"
#include "scantet/surface/known_boundary_impl.h"
#include "scantet/surface/misplaced_groups_impl.h"
#include "scantet/surface/pieces_impl.h"
#include "scantet/surface/restricted_triangulation_impl.h"

namespace scantet::engine {

/// Where the boundary of the mesh is not like that of the domain.
struct Tangles {
  /// The boundary facets, as seen from it, of each piece that is not the main one of its component.
  std::vector<std::vector<FacetCode>> pieces;
  std::vector<PointId> vertices;       ///< without a disk around them
  std::shared_ptr<Pieces> all_pieces;  ///< that the facets were taken from; null only if there are none
};

/// Where the level set is pinched or folded to a wedge it is not Lipschitz (paper, section 6), and D|O(P) breaks into
/// tets that touch along edges or at vertices only, however dense the sample. There, groups of tets smaller than a cube
/// of side α·σ change sides, unless a vertex off ∂O would come to the surface:
/// - fragments: pieces of the inside or of the outside that are not the main piece of their component of the domain;
/// - pinches: the smallest of the groups that the tets around a vertex fall into, where a side has more than one; if
///   none of that side may change, the smallest of those that part them.
/// Tets around a vertex off ∂O that has come to the surface all go to its side.
/// No tet changes more than six times for its own sake, so this ends; what is left over the audit reports. Groups that
/// make a handle, or take one away, change sides in the same way where they must (turn_over).
class Untangler {
 public:
  /// boundary: of this triangulation. Fragments can only be told from small components if the domain lists its
  /// components.
  Untangler(const Domain& domain, RestrictedTriangulation& triangulation, KnownBoundary& boundary,
            const SizingField& size, double alpha)
      : domain_(domain),
        knows_components_(!domain.components().empty()),
        restricted_(triangulation),
        t_(triangulation.triangulation()),
        boundary_(boundary),
        size_(size),
        alpha_(alpha) {}

  /// May run again after points have been inserted: tets that have changed sides before stay as they are, but around a
  /// vertex off ∂O that has come to the surface. Returns how many tets there are that have changed sides, also those
  /// that are back in the end.
  std::uint64_t run();

  /// Where neither a denser sample nor run() gives the boundary the domain's Euler number: has groups of tets change
  /// sides that are in another region than the domain has there, as long as that brings it nearer (misplaced_groups).
  /// groups: as misplaced_groups() has them. missing: by how much the Euler number of the inside is to grow. Return:
  /// whether any has.
  bool turn_over(const std::vector<MisplacedGroup>& groups, std::int64_t missing);

  /// The centroids of tets that have changed sides, in the order of their slots.
  std::vector<Point> changed_places() const;

  /// The tangles that are left.
  Tangles tangles();

 private:
  bool exposes_a_vertex(Pieces& pieces, CellId cell);
  bool absorb_fragments();
  bool mend_pinches();
  bool mend_around(PointId v);
  /// A group of tets of one side around a vertex.
  struct Group {
    std::vector<CellId> cells;
    double volume = 0;
    bool on_surface = true;
    std::map<Region, int> across;  ///< how many facets lead to which region
  };
  std::vector<Group> groups_of(PointId v, std::vector<CellId>& star) const;
  std::vector<Group> small_groups(PointId v, std::vector<CellId>& star) const;
  bool is_small(double volume_mm3, CellId cell) const;
  bool has_changed(CellId cell) const {
    return changes_[cell].count > 0 && t_.is_cell(cell) && changes_[cell].generation == t_.info(cell).generation;
  }
  bool can_change(CellId cell) const;
  bool change(CellId cell, Region region);
  void turn(CellId cell, Region region);
  bool cover_vertices();

  const Domain& domain_;
  bool knows_components_;
  RestrictedTriangulation& restricted_;
  Triangulation& t_;
  KnownBoundary& boundary_;
  const SizingField& size_;
  double alpha_;
  /// How often a cell has changed sides.
  struct Change {
    std::uint32_t generation = 0;  ///< of the cell's slot
    std::uint32_t count = 0;
  };
  std::vector<Change> changes_;                 // by slot, as far as any has changed
  std::unordered_set<PointId> changed_around_;  // vertices, since mend_pinches() has begun
  std::vector<CellId> star_;
};

}  // namespace scantet::engine
