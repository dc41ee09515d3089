// How two meshes differ, as reports show it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scantet/check/attached_difference.h"
#include "scantet/check/mesh_difference.h"
#include "scantet/report/report.h"

namespace scantet {

/// What `scantet diff` found.
struct ReportDifference {
  bool same_bytes = false;
  double tolerance_mm = 0;           ///< 0: the same tets are asked for
  double field_tolerance = 0;        ///< a share of a field's greatest magnitude
  std::vector<std::string> reasons;  ///< why the meshes differ by more than that; empty: they are the same
  /// What the files say of how they were made, where these differ: options that only one has, or all of it.
  std::array<std::string, 2> provenance;
  MeshDifference mesh;
  AttachedDifference attached;
  std::array<std::string, 2> not_compared;  ///< of what the files may hold; empty: nothing is left out

  bool is_same() const { return reasons.empty(); }
};

/// One line of the comparison.
struct DifferenceRow {
  std::string what;
  std::array<std::string, 2> values;  ///< of the first mesh and of the second
  std::string change;                 ///< from the first to the second; empty: none, or no number
};

/// "(1, -2.5, 30.12) mm"
std::string place_text(const Point& place);

/// "the same: the files have the same bytes", "different: ...".
std::string difference_verdict(const ReportDifference& difference);

/// Counts, volumes, angles and shapes, topology, regions, distances and provenance. reports: of the two meshes.
std::vector<DifferenceRow> difference_rows(const ReportDifference& difference, std::span<const Report> reports);

/// The verdict, its reasons and the rows as columns; ends with a newline.
std::string difference_text(const ReportDifference& difference, std::span<const Report> reports);

/// Keys, always in this order: same, verdict, reasons[], same_bytes, sameness (arrays, numbering, tets or none),
/// tolerance_mm, field_tolerance, tets_alone[2], to_second and to_first.{lower_mm, upper_mm, points,
/// worst[].{distance_mm, place_mm}}, regions[].{region, sides[2].{name, tets, volume_mm3, area_mm2}},
/// patches[].{regions, facets[2], area_mm2[2]}, attached.{paired (each tet has its like), one_to_one (so have
/// vertices), edge_nodes.{largest_mm, places_mm[2]} (null: not compared), sets[].{name, of (vertices, facets or tets),
/// members[2], alone[2] (null: only counted), place_mm (null: nothing is alone)}, fields[].{name, largest (null:
/// infinite), scale, values[2], place_mm}}, not_compared[2], provenance[2] (where they differ), meshes[2] as in
/// json_report(). Ends with a newline.
std::string difference_json(const ReportDifference& difference, std::span<const Report> reports);

}  // namespace scantet
