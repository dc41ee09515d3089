// From a scan in memory to a checked mesh in memory, in one call: what the command `scantet mesh` does, without files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scantet/app/mesh_request.h"
#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/field/level_settings.h"
#include "scantet/field/scan.h"
#include "scantet/labels/label_settings.h"
#include "scantet/reading/simplify.h"
#include "scantet/report/report.h"

namespace SCANTET_API scantet {

/// Which object in a scan is meshed, and how. Every default is that of the command, but for the level and for how
/// labels are smoothed.
struct ScanMeshOptions : MeshRequest {
  /// Of the surface, in the units of the voxel values. Several: regions inside each other, 1 between the outermost
  /// level and the next, and so on. None: suggested_level(), and a note says which that is.
  std::vector<double> levels;
  InsideSide inside = InsideSide::above;       ///< which side of the levels is the object
  std::optional<double> outside;               ///< as LevelSetSettings::outside
  std::optional<std::uint64_t> largest_count;  ///< ≥ 1: only so many of the largest components are meshed; none: all
  double min_component_mm3 = 0;                ///< components of less volume are left out
  double fill_cavities_mm3 = 0;                ///< cavities of less volume are filled
  /// The scan is a segmentation: these of its labels are meshed, and no level is asked of it. None: it is a grey image.
  std::optional<LabelSettings> labels;
  bool as_grey = false;           ///< values of a label map are taken for grey values
  Simplification simplification;  ///< what is done to the scan before all else; audited is what remains
  /// Then handles of the object that are thinner than this are cut, and tunnels filled, > 0; of one level. None: they
  /// stay. Audited is what remains.
  std::optional<double> close_handles_mm;
};

/// A mesh and what is known of it.
struct MeshOutcome {
  bool cancelled = false;          ///< the rest is empty
  TetMesh mesh;                    ///< world mm, in the scan's frame (LPS)
  Report report;                   ///< all that was measured: quality, bounds, audit, stages; write_report() writes it
  std::vector<std::string> notes;  ///< worth knowing: the level and size chosen by default, expected trouble
  std::vector<std::string> findings;  ///< bounds unmet and faults of the mesh; empty: all is as asked for
};

/// Meshes a level set of the scan, or several, improves the mesh until it keeps the bounds, meshes finer where that
/// does not do, and audits the mesh against the scan: levels, size, mesh_and_optimize(), audit(). Of a segmentation the
/// same of its labels, each as a region (options.labels).
///
/// scan: as read_scan(), make_scan() or an adapter makes it. options.mesher.threads: for all of it. progress: whatever
/// it is cancelled for (Progress::out_of_budget(), too), there is no mesh then. Texts name options as the command calls
/// them ("--size").
/// Throws Error. Of the object: input.labels (a label map, unless labels or as_grey), usage.labels (labels beside what
/// is asked of levels or grey values), what simplified(), make_nested_level_sets() and make_label_object() throw,
/// usage.smooth (labels smoothed by more than the image is long), usage.close_handles (several levels, or wider than
/// the image is long), input.components (nothing is left), usage.cut, input.cut (nothing is left). Of sizes:
/// usage.size, usage.formula, usage.region_size, usage.layers, usage.size_where, usage.place, usage.target_tets,
/// usage.no_effect (makes no sense, or not of this object), usage.gap, usage.memory, usage.max_vertices (too large a
/// mesh), input.size_image and what read_scan() throws (a file of sizes); usage.value (min_edge). Of the mesh: what
/// mesh_domain() and optimize_mesh() throw, input.empty_mesh (the size is too large for the object), usage.order (too
/// many nodes), input.too_large (2^27 tets). Guarantees: the same scan and options give the same mesh, bit for bit, and
/// that is the command's mesh of the same scan; nothing is printed.
MeshOutcome mesh_scan(const Scan& scan, const ScanMeshOptions& options, Progress& progress);

}  // namespace scantet
