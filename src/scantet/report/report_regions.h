// What a report says of each region of a mesh.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/color.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/check/audit.h"
#include "scantet/quality/quality.h"

namespace SCANTET_API scantet {

/// A region that shares boundary facets with another one.
struct ReportNeighbor {
  Region region = kOutside;
  double area_mm2 = 0;
  std::uint64_t facets = 0;
};

/// A region of the mesh, or of the grid that the mesh was made from: a label.
struct ReportRegion {
  Region region = kOutside;               ///< kOutside only of a grid: what is background there
  std::string name;                       ///< region_name(); "background" for kOutside
  Color color;                            ///< the input's, or region_color()
  RegionVolume mesh;                      ///< no tets if the mesh has none of it
  std::uint64_t components = 0;           ///< of the mesh
  std::vector<ReportNeighbor> neighbors;  ///< ascending, kOutside among them
  std::optional<KeptRegion> grid;         ///< if the mesh was made from a grid of regions
  double voxels_mm3 = 0;                  ///< volume of its voxels; with a grid

  /// Whether the volume of the domain's region is known, and so that of the voxels that the mesh should have: not of
  /// one that is cut. Without a grid: false.
  bool is_whole() const;
  /// Of its boundary facets, of all neighbours together.
  double area_mm2() const;
  /// By how many percent the mesh's volume is more than the voxels'; negative if it is less. None unless is_whole(), or
  /// without voxels.
  std::optional<double> off_voxels_percent() const;
  /// Likewise than that of the domain's region. None unless is_whole(), or if that has no volume.
  std::optional<double> off_field_percent() const;
};

/// A colour for a region that has none: the same for the same number, apart from those of the next numbers.
Color region_color(Region region);

/// "#a0b1c2".
std::string color_text(const Color& color);

/// Lists the regions of a mesh, of its quality and of a complete audit, ascending; with those of the audit's region
/// ledger that the mesh has not, and of that ledger also kOutside. mesh: its names alone are used. colors: of regions
/// that have one. voxel_mm3: volume of a voxel of the ledger's grid; of no meaning without a ledger.
std::vector<ReportRegion> report_regions(const TetMesh& mesh, const QualitySummary& quality, const AuditReport& audit,
                                         const std::map<Region, Color>& colors = {}, double voxel_mm3 = 0);

}  // namespace scantet
