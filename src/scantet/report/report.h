// Everything a run or an inspection has to report, and the files it is written to: JSON, CSV, images of the histograms
// and a page to explore the mesh in.
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
#include "scantet/check/audit.h"
#include "scantet/quality/quality.h"
#include "scantet/report/report_theory.h"

namespace scantet {

class FileSet;

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
  std::uint64_t boundary_vertices = 0;  ///< of boundary facets
  double volume_mm3 = 0;
  std::vector<RegionVolume> regions;  ///< ascending by region
};

/// What the refinement rules did (points inserted), and the elements of the finished mesh for which they do not hold.
struct ReportRules {
  std::uint64_t initial_points = 0;
  std::uint64_t repair_points = 0;  ///< inserted beside the rules, to mend the topology of the sample
  std::uint64_t absorbed_tets = 0;  ///< in fragments that changed sides
  std::uint64_t r1 = 0;
  std::uint64_t r2 = 0;
  std::uint64_t r3_1 = 0;
  std::uint64_t r3_2 = 0;
  std::uint64_t unmet_r1 = 0;        ///< boundary facets
  std::uint64_t unmet_r2 = 0;        ///< boundary facets
  std::uint64_t unmet_r3 = 0;        ///< tets
  std::uint64_t lattice_points = 0;  ///< inside, that the rules started from beside the initial sample
};

/// A bound that was asked for, and which elements of the finished mesh break it.
struct ReportBound {
  std::string name;             ///< "min_dihedral_deg", "facet_radius_edge"; docs/reports.md has all
  std::string what;             ///< for people: "R1: radius-edge ratio of facets"
  std::string options;          ///< that ask for it: "--size or --alpha", "--min-dihedral 10"
  bool is_least = false;        ///< values must be at least `asked`; else at most
  double asked = 0;             ///< in the unit of the values
  std::uint64_t broken = 0;     ///< elements that break it
  std::uint64_t of = 0;         ///< elements in all
  std::optional<double> worst;  ///< of the element that breaks it most; infinite if that is degenerate
  std::optional<Point> place;   ///< the centroid of that element, world mm
};

struct ReportOptimizerStage {
  std::string stage;  ///< "exude", "improve"
  double seconds = 0;
  std::uint64_t changes = 0;
  double min_dihedral_before_deg = 0;
  double min_dihedral_after_deg = 0;
};

/// "dihedral angle, degrees under 10: 3 of 4,567, the worst with 9.8 at (1, 2, 3) mm". Pre: some element breaks it.
std::string broken_text(const ReportBound& bound);

/// What was done for the bounds after refinement.
struct ReportOptimization {
  double target_deg = 0;         ///< for the smallest dihedral angle; 0: none
  std::uint64_t tets_below = 0;  ///< tets with a smaller dihedral angle that are left
  std::vector<ReportOptimizerStage> stages;
  std::uint64_t finer_places = 0;          ///< where the size was made finer for it
  std::optional<double> smallest_size_mm;  ///< there
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

/// A file that was written with the report.
struct ReportFile {
  std::string path;
  std::string sha256;  ///< of its bytes, 64 digits
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
  std::optional<std::string> stop;                   ///< "converged", "limit", "time" or "memory"
  std::optional<ReportLimit> limit;
  std::optional<ReportTheory> theory;          ///< none if all is proven
  std::optional<ReportComponents> components;  ///< if the user chose among them
  std::optional<ReportMesh> mesh;
  std::optional<QualitySummary> quality;
  std::optional<ReportRules> rules;
  std::vector<ReportBound> bounds;  ///< all that were asked for; the mesh as it is now
  std::optional<ReportOptimization> optimization;
  std::optional<AuditReport> audit;
  std::optional<ReportTiming> timing_s;
  std::vector<ReportFile> files;    ///< of the same run: if all are as listed, the set is whole
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
/// set: the files that this one is to appear with; null: it appears at once.
/// Throws Error: usage.format (unknown extension), output.* (see AtomicFile), internal.chart (see write_svg).
void write_report(std::span<const Report> reports, std::span<const TetMesh> meshes, const std::string& path,
                  FileSet* set = nullptr);

}  // namespace scantet
