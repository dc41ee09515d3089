// Everything a run or an inspection has to report, and its forms: text, JSON, CSV, pictures of the histograms, a page.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "scantet/base/frame.h"
#include "scantet/base/options.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/quality/audit.h"
#include "scantet/quality/quality.h"

namespace scantet {

struct ReportInput {
  std::string path;
  std::string sha256;          ///< of all that was read, images of sizes included; 64 digits, empty if unknown
  std::optional<Frame> frame;  ///< index to world, mm, if the input is a grid
};

/// null: no value ("no bound").
using ReportValue = std::variant<std::nullptr_t, bool, std::uint64_t, double, std::string, std::vector<std::string>,
                                 std::vector<double>>;

struct ReportOption {
  std::string name;  ///< without dashes
  ReportValue value;
};

/// Which components of the input were left out as asked for.
struct ReportComponents {
  struct Dropped {
    Point witness;  ///< a point in it, world mm
    double volume_mm3 = 0;
    Region region = 1;  ///< that it was a component of
  };
  std::uint64_t found = 0;        ///< before any was dropped
  double dropped_volume_mm3 = 0;  ///< of all together
  std::vector<Dropped> dropped;   ///< largest first
};

struct ReportMesh {
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
  std::uint64_t boundary_facets = 0;
  std::uint64_t boundary_vertices = 0;  ///< flagged on_boundary
  double volume_mm3 = 0;
  std::vector<RegionVolume> regions;  ///< ascending by region
};

/// What the refinement rules did (points inserted), and the elements for which they do not hold.
struct ReportRules {
  std::uint64_t initial_points = 0;
  std::uint64_t repair_points = 0;  ///< inserted beside the rules, to mend the topology of the sample
  std::uint64_t absorbed_tets = 0;  ///< in fragments that changed sides
  std::uint64_t r1 = 0;
  std::uint64_t r2 = 0;
  std::uint64_t r3_1 = 0;
  std::uint64_t r3_2 = 0;
  std::uint64_t unmet_r1 = 0;
  std::uint64_t unmet_r2 = 0;
  std::uint64_t unmet_r3 = 0;
  std::uint64_t lattice_points = 0;  ///< inside, that the rules started from beside the initial sample
  std::uint64_t unmet() const { return unmet_r1 + unmet_r2 + unmet_r3; }
};

/// How many elements of the finished mesh break each rule; of how many.
struct ReportConformance {
  std::uint64_t r1 = 0;  ///< boundary facets
  std::uint64_t r2 = 0;  ///< boundary facets
  std::uint64_t r3 = 0;  ///< tets
  std::uint64_t facets = 0;
  std::uint64_t tets = 0;
};

struct ReportOptimizerStage {
  std::string stage;  ///< "exude", "improve"
  double seconds = 0;
  std::uint64_t changes = 0;
  double min_dihedral_before_deg = 0;
  double min_dihedral_after_deg = 0;
};

/// What was done for the smallest dihedral angle after refinement.
struct ReportOptimization {
  double target_deg = 0;
  std::uint64_t tets_below = 0;  ///< tets with a smaller dihedral angle that are left
  std::vector<ReportOptimizerStage> stages;
  std::uint64_t finer_places = 0;          ///< where the size was made finer for it
  std::optional<double> smallest_size_mm;  ///< there
  std::optional<ReportConformance> after;  ///< rules broken by the mesh as it is now; none if nothing was done
};

/// Where refinement was busy when the vertex limit stopped it.
struct ReportLimit {
  std::string rule;  ///< "R3.1"
  Point place;       ///< world mm
  double insertion_radius_mm = 0;
};

/// Seconds of wall time; none for what was not done.
struct ReportTiming {
  std::optional<double> read;
  std::optional<double> sample;
  std::optional<double> refine;
  std::optional<double> optimize;
  std::optional<double> audit;
  std::optional<double> write;
  std::optional<double> total;
};

/// A part of sampling and refining.
struct ReportStage {
  std::string stage;         ///< "boundary sample", "R2"
  double seconds = 0;        ///< wall time
  std::uint64_t points = 0;  ///< that it added to the mesh
};

/// A report; what is absent or empty is left out of every form.
struct Report {
  std::string version;  ///< of scantet
  std::optional<ReportInput> input;
  std::optional<std::vector<ReportOption>> options;  ///< resolved, in the order of declaration
  std::optional<std::string> stop;                   ///< "converged", "cancelled" or "limit"
  std::optional<ReportLimit> limit;
  std::optional<ReportComponents> components;  ///< if the user chose among them
  std::optional<ReportMesh> mesh;
  std::optional<QualitySummary> quality;
  std::optional<ReportRules> rules;  ///< as refinement left them
  std::optional<ReportOptimization> optimization;
  std::optional<AuditReport> audit;
  std::optional<ReportTiming> timing_s;
  std::vector<ReportStage> stages;  ///< what timing_s.sample and timing_s.refine were spent on, in order
};

/// The counts of a mesh; its volumes are those of `quality`.
ReportMesh report_mesh(const TetMesh& mesh, const QualitySummary& quality);

/// Every option with the value it has now: flags, numbers and whole numbers as such, the rest as text. Of a repeatable
/// number that was given once: the number, as if it could not be repeated.
std::vector<ReportOption> report_options(const OptionSet& options);

/// What write_report can write: ".json", ".csv", ".html", ".svg", ".png". docs/reports.md says what each holds.
const std::vector<std::string>& report_extensions();

/// Writes one report, or several side by side, in the form that the extension of `path` names (upper or lower case),
/// whole or not at all. meshes: what each report is of, for the view in the .html page; as many as reports.
/// Throws Error: usage.format (unknown extension), output.* (see AtomicFile), internal.chart (see write_svg).
void write_report(std::span<const Report> reports, std::span<const TetMesh> meshes, const std::string& path);

/// Keys, always in this order; names are kept from version to version:
///   version, input.{path, sha256, frame.{origin_mm, columns_mm}}, options.{name: value}, stop,
///   limit.{rule, place_mm, insertion_radius_mm},
///   components.{found, dropped.{count, volume_mm3, largest[].{volume_mm3, witness_mm, region}}} (the ten largest),
///   mesh.{vertices, tets, boundary_facets, boundary_vertices, volume_mm3, regions[].{region, tets, volume_mm3}},
///   quality.{min_dihedral_deg, max_dihedral_deg, min_facet_angle_deg, max_radius_edge, max_circumradius_mm,
///     histograms.MEASURE.{edges, counts}, statistics.MEASURE.{count, infinite, min, max, mean, p1 … p99},
///     tets_under_deg.{5, 10, 15, 20}, regions[].{region, tets, volume_mm3},
///     worst.{min_dihedral_deg, max_radius_edge}[].{tet, place_mm, value}}
///     with MEASURE one of inverse_aspect, dihedral_deg, radius_edge, edge_length_mm, circumradius_mm, volume_mm3,
///     size_ratio (circumradius over the sizing field; only of a run that had one),
///   rules.{r1, r2, r3_1, r3_2, unmet.{r1, r2, r3}, initial_points, lattice_points, repair_points, absorbed_tets},
///   optimization.{target_deg, tets_below, stages[].{stage, seconds, changes, min_dihedral_before_deg,
///     min_dihedral_after_deg}, finer.{places, smallest_size_mm}, unmet.{r1, r2, r3, facets, tets}},
///   topology.{components, boundary_components, euler (of the boundary), manifold, cavities, vertex_components,
///     mesh_euler, non_manifold_edges, non_manifold_vertices, component_list[].{region, tets, volume_mm3, box_mm,
///     surfaces, boundary_euler}, interfaces[].{regions, facets, surfaces, euler}, expected.{components, cavities},
///     missing[].{kind, region, witness_mm, box_mm, volume_mm3}},
///   audit.{passed, complete, max_residual, circumcentres_astray, findings[].{code, count, message, remedy, where_mm}},
///   timing_s.{read, sample, refine, optimize, audit, write, total},
///   stages[].{stage, seconds, points} (of sampling and refining, in order).
/// Numbers read back as the same doubles; null for what is infinite or has no value; bytes that are not UTF-8 are
/// replaced. Ends with a newline. Of several reports: meshes[], each with those keys.
std::string json_report(std::span<const Report> reports);
inline std::string json_report(const Report& report) {
  return json_report({&report, 1});
}

/// The histograms: columns measure, bin_low, bin_high, count. Only the header without quality. Of several reports: a
/// column mesh before these, with the file's name (its path, where two are called the same).
std::string csv_report(std::span<const Report> reports);
inline std::string csv_report(const Report& report) {
  return csv_report({&report, 1});
}

struct TextStyle {
  int width = 80;       ///< columns, at least 40
  bool unicode = true;  ///< false: ASCII only
};

/// What people see at the end of a run: counts, volume, quality with histograms of the dihedral angles and the inverse
/// aspect ratio, topology, rules, times, stages, and what is wrong with the remedy. No line is wider than style.width,
/// unless one word is. Ends with a newline, unless the report is empty.
std::string text_report(const Report& report, const TextStyle& style = {});

}  // namespace scantet
