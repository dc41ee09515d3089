// The wording of the findings: one table for the code, the people and the documentation.
#include <cstring>

#include "scantet/check/audit_impl.h"

namespace scantet {

const std::vector<FindingKind>& finding_kinds() {
  static constexpr const char* kBug = "this is a fault of the mesher, please report it with the command line";
  static constexpr const char* kFinerBoundary = "mesh with a smaller --size, or bound --facet-distance";
  static const std::vector<FindingKind> kinds{
      {"audit.arrays", "arrays of the wrong length", "one region per tet and facet, one flag per vertex"},
      {"audit.not_finite", "vertices with a coordinate that is not finite", "repair the file"},
      {"audit.bad_index", "tets with a vertex that does not exist", "repair the file"},
      {"audit.repeated_vertex", "tets that use a vertex twice", "remove these tets"},
      {"audit.orientation", "tets without positive volume",
       "swap two vertices of a negative tet; remove or reshape a flat one"},
      {"audit.outside_region", "tets in the outside region 0", "give every tet a region from 1 on"},
      {"audit.unused_vertex", "vertices that no tet uses", "remove them"},
      {"audit.same_point", "vertices at the place of an earlier one",
       "merge them, or move the parts of the mesh apart"},
      {"audit.same_tet", "tets with the vertices of an earlier one", "remove them"},
      {"audit.crowded_face", "faces of more than two tets", "remove the tets that overlap"},
      {"audit.folded_face", "faces with both tets on the same side", "remove the tets that overlap"},
      {"audit.facet_missing", "boundary faces that are not listed as facets", "rebuild the boundary from the tets"},
      {"audit.facet_extra", "listed facets that are no boundary face", "rebuild the boundary from the tets"},
      {"audit.facet_twice", "facets listed again", "rebuild the boundary from the tets"},
      {"audit.facet_regions", "facets with the wrong regions", "rebuild the boundary from the tets"},
      {"audit.facet_orientation", "facets oriented the wrong way", "rebuild the boundary from the tets"},
      {"audit.boundary_flag", "vertices of boundary facets that are not flagged", "rebuild the boundary from the tets"},
      {"audit.boundary_edge", "boundary edges that are not manifold", kFinerBoundary},
      {"audit.boundary_vertex", "boundary vertices that are not manifold", kFinerBoundary},
      {"audit.crossing", "boundary facets that cross another one, so that the mesh overlaps itself",
       "mesh with a smaller --size there, or with --optimize none"},
      {"audit.off_boundary", "boundary vertices off the domain's boundary",
       "check that mesh and domain belong together (level, --space)"},
      {"audit.circumcentre", "tets with their circumcentre in another region", kBug},
      {"audit.curve", "gaps where the mesh does not follow a curve of the domain",
       "choose a smaller --size: curves that come closer to each other than a tenth of it, rims and sharp edges than a "
       "fiftieth, are not parted, and wedges under 15 degrees may be cut off"},
      {"audit.component_missing", "components of the domain that the mesh has not",
       "mesh with a smaller --size if they matter"},
      {"audit.cavity_missing", "cavities of the domain that the mesh has not",
       "mesh with a smaller --size if they matter"},
      {"audit.lost_part", "places of the surface that are farther from the mesh than twice the size there",
       "mesh with a smaller --size, or bound it: --max-distance"},
      {"audit.lost_label", "parts of labels that no voxel centre of theirs finds in the mesh",
       "mesh with a smaller --size"},
      {"audit.shrunk_label", "parts of labels of which the mesh keeps less than half of the voxel centres",
       "mesh with a smaller --size"},
      {"audit.joined_label", "parts of labels that lie in one part of the mesh with others that they do not touch",
       kFinerBoundary},
      {"audit.split_label", "pieces that the mesh tears off parts of labels", kFinerBoundary},
      {"audit.broken_label",
       "places where the mesh breaks what joins voxels of a label, or of the background: a handle that is lost, or a "
       "hole",
       kFinerBoundary},
      {"audit.component_count", "components too many or too few", kFinerBoundary},
      {"audit.component_joined", "components of the domain that the mesh has in one with others", kFinerBoundary},
      {"audit.component_split", "components of the domain that the mesh has in several parts", kFinerBoundary},
      {"audit.cavity_joined", "cavities of the domain that the mesh has open, or in one with others", kFinerBoundary},
      {"audit.cavity_count", "cavities too many or too few", kFinerBoundary},
      {"audit.handles", "components whose boundary has not the handles of the domain's",
       "mesh with a smaller --size, or bound --facet-distance; where a note names another --level, at that"},
  };
  return kinds;
}

namespace auditing {

void record(const Tally& tally, AuditReport& report) {
  if (tally.count == 0) return;
  for (const FindingKind& kind : finding_kinds()) {
    if (std::strcmp(kind.code, tally.code) != 0) continue;
    report.findings.push_back(
        {kind.code, tally.count,
         std::string(kind.what) + ": " + std::to_string(tally.count) + ", the first is " + tally.first, kind.remedy,
         tally.places.empty() ? Point{} : tally.places.front(), tally.places});
  }
}

}  // namespace auditing
}  // namespace scantet
