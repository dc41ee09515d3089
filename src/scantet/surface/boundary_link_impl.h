// Private: whether the boundary of the mesh is a surface at its vertices.
#pragma once

#include <functional>
#include <vector>

#include "scantet/surface/boundary_facets_impl.h"

namespace scantet::engine {

/// Finds out, for each of the vertices, all on ∂O and ascending, whether the boundary facets around it form one disk,
/// and notes that. On a junction curve or at a corner, or beside one that stands for several, it finds out whether the
/// regions meet well there (regions_meet_well). junctions: of this triangulation. facets: gives all of them; it is
/// called only if there are many vertices. Returns the vertices without a disk, ascending; a vertex without facets has
/// none.
std::vector<PointId> check_disks(const Triangulation& t, DiskNotes& notes, const Junctions& junctions,
                                 const std::vector<PointId>& vertices,
                                 const std::function<const BoundaryFacets&()>& facets);

/// The vertices on ∂O without a disk, kept up to date.
class BrokenDisks {
 public:
  explicit BrokenDisks(RestrictedTriangulation& triangulation) : triangulation_(triangulation) {}

  /// Asks of all vertices that are in question (RestrictedTriangulation::question). facets: as check_disks() needs it.
  void update(const std::function<const BoundaryFacets&()>& facets);

  /// All of them, ascending, as of the last update.
  const std::vector<PointId>& all() const { return all_; }
  /// Those of them that boundary facets have, ascending.
  std::vector<PointId> on_facets() const;
  /// Those that the last update asked of, and those of them without a disk, ascending.
  const std::vector<PointId>& asked() const { return asked_; }
  const std::vector<PointId>& found() const { return found_; }

 private:
  RestrictedTriangulation& triangulation_;
  std::vector<PointId> all_;
  std::vector<PointId> asked_;
  std::vector<PointId> found_;
};

}  // namespace scantet::engine
