// The forms of a report that are text: JSON, CSV, and what a terminal shows.
#pragma once

#include <span>
#include <string>

#include "scantet/base/api.h"
#include "scantet/report/report.h"

namespace SCANTET_API scantet {

/// Keys, always in this order; names are kept from version to version:
///   version, input.{path, sha256, frame.{origin_mm, columns_mm}}, options.{name: value}, stop,
///   limit.{rule, place_mm, insertion_radius_mm}, theory.{theorem, needed[], meaning} (if bounds are beyond proofs),
///   components.{found, dropped.{count, volume_mm3, largest[].{volume_mm3, witness_mm, region}}} (the ten largest),
///   mesh.{vertices, tets, boundary_facets, boundary_vertices, volume_mm3, regions[].{region, tets, volume_mm3}},
///   quality.{min_dihedral_deg, max_dihedral_deg, min_facet_angle_deg, max_radius_edge, max_circumradius_mm,
///     min_edge_length_mm, min_height_mm, min_scaled_jacobian, min_volume_mm3, median_volume_mm3, max_stiffness_ratio,
///     condition_factor, min_stable_time_step_us, wave_speed_m_per_s, min_edge_size_ratio (if there was a sizing
///     field), histograms.MEASURE.{edges, counts}, statistics.MEASURE.{count, infinite, min, max, mean, p1 … p99},
///     tets_under_deg.{5, 10, 15, 20}, regions[].{region, tets, volume_mm3},
///     worst.{min_dihedral_deg, max_radius_edge, min_edge_length_mm, min_height_mm, min_scaled_jacobian,
///     max_dihedral_deg, min_volume_mm3, max_stiffness_ratio, min_edge_size_ratio (if there was a sizing
///     field)}[].{tet, place_mm, value}} with MEASURE one of inverse_aspect, dihedral_deg, radius_edge, edge_length_mm,
///     scaled_jacobian, largest_dihedral_deg, min_height_mm, stable_time_step_us (least height over wave speed),
///     stiffness_ratio (for the shape of the tet), circumradius_mm, volume_mm3, size_ratio (circumradius over the
///     sizing field; only of a run that had one), edge_size_ratio (length over the size asked for; likewise),
///   rules.{r1, r2, r3_1, r3_2, unmet.{r1, r2, r3}, initial_points, lattice_points, repair_points, absorbed_tets},
///   optimization.{target_deg, tets_below, stages[].{stage, seconds, changes, min_dihedral_before_deg,
///     min_dihedral_after_deg}, finer.{places, smallest_size_mm}},
///   bounds[].{name, asked, broken, of, worst, place_mm (these two if it is broken)} (of the finished mesh),
///   short_edges.{than, is_bound, count, of, place_count, places[].{place_mm, length_mm, edges}} (the 100 worst
///   places), topology.{components, boundary_components, euler (of the boundary), manifold, cavities,
///   vertex_components,
///     mesh_euler, non_manifold_edges, non_manifold_vertices, component_list[].{region, tets, volume_mm3, box_mm,
///     surfaces, boundary_euler}, handles (of the boundary; null if it is not manifold, or of several regions),
///     surface_list[].{component (index into component_list), euler, handles, volume_mm3, box_mm},
///     cavity_list[].{euler, handles, volume_mm3, box_mm}, interfaces[].{regions, facets, surfaces, euler, area_mm2,
///     min_angle_deg, mean_angle_deg (of the facets: of each one's least), min_edge_mm, mean_edge_mm},
///     expected.{components, cavities}, missing[].{kind, region, witness_mm, box_mm, volume_mm3} (these two only of a
///     mesh that was held against its domain's components; expected is null where the domain does not know them and is
///     no grid of regions),
///     handle_check.{compared, compared_cavities, unknown, handles, expected_handles, euler, expected_euler,
///     domain_euler, different[].{kind, region, witness_mm, box_mm, volume_mm3, handles, expected_handles, euler,
///     expected_euler}} (only of a mesh that was held against its domain; null where that does not know its handles)},
///   regions[].{region, name, color, tets, volume_mm3, min_dihedral_deg, max_dihedral_deg, components, area_mm2,
///     neighbors[].{region, area_mm2, facets}; of a label map also voxels, voxels_kept (whose centres lie in tets of
///     the region), lost_voxels_mm[] (the others, 100,000 at most), voxels_mm3, off_voxels_percent, field_mm3,
///     off_field_percent (these three null where the region is cut), field_components; region 0, its background, has
///     name and the first three of these},
///   audit.{passed, complete, max_residual, circumcentres_astray, findings[].{code, count, message, remedy, where_mm,
///   places_mm[]}}, layers.{vertices (of boundaries), broken (those with fewer layers across), places[].{place_mm,
///   layers}} (the 100
///     worst; only if layers were asked for),
///   distance.{to_mesh, to_surface}.{lower_mm, upper_mm (null: not bounded), points, worst[].{distance_mm, place_mm},
///     parts, beyond, undecided (these three only with a limit)}, distance.limit_mm,
///   certificate.{grade, and the keys of docs/certificate.md, file (the mesh file that was verified), points_added (by
///     --certify refine)} (if it was asked for),
///   fields[].{name, scan, measure, min, max, mean, total, tets_outside} (docs/fields.md),
///   second_order.{edges, boundary_edges, on_boundary, eased_edges, eased_tets, unproved, least_share, volume_mm3}
///     (docs/second_order.md),
///   timing_s.{read, sample, refine, optimize, audit, write, total},
///   files[].{path, sha256} (of the same run),
///   stages[].{stage, seconds, points} (of sampling and refining, in order),
///   phases[].{stage, part, seconds, cpu_seconds} (of reading, checking and writing, in order).
/// What a report has not is left out. Numbers read back as the same doubles; null for what is infinite or has no value;
/// bytes that are not UTF-8 are replaced. Ends with a newline. Of several reports: meshes[], each with those keys.
std::string json_report(std::span<const Report> reports);
/// Of one.
inline std::string json_report(const Report& report) {
  return json_report({&report, 1});
}

/// The histograms, a bin a line: columns measure, bin_low, bin_high, count, under a line with these names; that line
/// alone without quality. Of several reports: a column mesh before these, in quotes, with the name of the input's file
/// (its path, where two are called the same; a number, where that is the same, too).
std::string csv_report(std::span<const Report> reports);
/// Of one.
inline std::string csv_report(const Report& report) {
  return csv_report({&report, 1});
}

/// What a terminal can show.
struct TextStyle {
  int width = 80;       ///< columns; less than 40 count as 40
  bool unicode = true;  ///< false: ASCII only
};

/// What people see at the end of a run: counts, volume, quality, regions, topology, distances, what was proved, rules,
/// improvement, bounds, times and stages; histograms of dihedral angles, inverse aspect ratios, least heights, volumes
/// and, with a sizing field, of edges; and what is wrong with the remedy. No line is wider than style.width, unless one
/// word is, or the numbers in a row of a histogram. Ends with a newline, unless the report is empty.
std::string text_report(const Report& report, const TextStyle& style = {});

}  // namespace scantet
