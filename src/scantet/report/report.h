// Everything a run or an inspection has to report, and the files it is written to: JSON, CSV, images of the histograms
// and a page to explore the mesh in.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/frame.h"
#include "scantet/base/options.h"
#include "scantet/base/run_account.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/certificate/certificate_text.h"
#include "scantet/check/audit.h"
#include "scantet/check/conformance.h"
#include "scantet/check/distance.h"
#include "scantet/check/layers.h"
#include "scantet/domain/domain.h"
#include "scantet/quality/quality.h"
#include "scantet/report/report_model.h"
#include "scantet/report/report_regions.h"
#include "scantet/report/report_scan.h"
#include "scantet/report/report_theory.h"

namespace SCANTET_API scantet {

class FileSet;
struct ReportDifference;

/// What was meshed.
struct ReportInput {
  std::string path;            ///< as typed
  std::string sha256;          ///< of all that was read, images of sizes included; 64 digits, empty if unknown
  std::optional<Frame> frame;  ///< index to world, mm, if the input is a grid
};

/// null: no value ("no bound").
using ReportValue = std::variant<std::nullptr_t, bool, std::uint64_t, double, std::string, std::vector<std::string>,
                                 std::vector<double>>;

/// An option and its value in this run.
struct ReportOption {
  std::string name;  ///< without dashes
  ReportValue value;
};

/// The counts of the mesh. Volumes are sums of signed volumes.
struct ReportMesh {
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
  std::uint64_t boundary_facets = 0;
  std::uint64_t boundary_vertices = 0;  ///< of boundary facets
  double volume_mm3 = 0;
  std::vector<RegionVolume> regions;  ///< ascending by region
};

/// A bound that was asked for, and which elements of the finished mesh break it.
struct ReportBound {
  std::string name;               ///< "min_dihedral_deg", "facet_radius_edge"; docs/reports.md has all
  std::string what;               ///< for people: "R1: radius-edge ratio of facets"
  std::string options;            ///< that ask for it: "--size or --alpha", "--min-dihedral 10"
  bool is_least = false;          ///< values must be at least `asked`; else at most
  double asked = 0;               ///< in the unit of the values
  std::uint64_t broken = 0;       ///< elements that break it
  std::uint64_t of = 0;           ///< elements in all
  std::optional<double> worst{};  ///< of the element that breaks it most; infinite if that is degenerate
  std::optional<Point> place{};   ///< the centroid of that element, world mm
};

/// "dihedral angle, degrees under 10: 3 of 4,567, the worst with 9.8 at (1, 2, 3) mm". Pre: some element breaks it, and
/// `worst` and `place` are set.
std::string broken_text(const ReportBound& bound);

/// Edges that are shorter than solvers like.
struct ReportShortEdges {
  std::string than;                    ///< "5% of the size", "0.2 mm"
  bool is_bound = false;               ///< asked for, so that it is one of the bounds, too
  std::uint64_t count = 0;             ///< edges that are shorter
  std::uint64_t of = 0;                ///< edges in all
  std::vector<ShortEdgePlace> places;  ///< as Conformance::short_edges
};

/// "12 of 4,567 edges are shorter than 5% of the size, at 3 places, the shortest 0.04 mm at (1, 2, 3) mm", of the first
/// place. Pre: there is a place.
std::string short_edges_text(const ReportShortEdges& edges);

/// What was done for the bounds after refinement.
struct ReportOptimization {
  double target_deg = 0;         ///< for the smallest dihedral angle; 0: none
  std::uint64_t tets_below = 0;  ///< tets with a smaller dihedral angle that are left
  std::vector<OptimizerStage> stages;
  std::uint64_t finer_places = 0;          ///< where the size was made finer for it
  std::optional<double> smallest_size_mm;  ///< there
};

/// Seconds of wall time; none for what was not done.
struct ReportTiming {
  std::optional<double> read;  ///< and what comes before sampling: sizes, for one
  std::optional<double> sample;
  std::optional<double> refine;
  std::optional<double> optimize;
  std::optional<double> audit;  ///< with the measures and what breaks bounds
  std::optional<double> write;  ///< meshes, and the reports written before this one
  std::optional<double> total;  ///< until this report is written

  /// Calls take(key, seconds) for each part in order, also those that are none, without the total.
  template <class Take>
  void for_each_part(const Take& take) const {
    take("read", read);
    take("sample", sample);
    take("refine", refine);
    take("optimize", optimize);
    take("audit", audit);
    take("write", write);
  }
};

/// What was proved of the mesh, from its file.
struct ReportCertificate {
  MeshCertificate proved;
  std::string file;  ///< the mesh file that was read again and verified
  /// Of each boundary facet: how far from the level set or surface it is at most, -1 if not bounded; none: unknown.
  std::vector<double> facets_mm{};
  std::optional<std::uint64_t> points_added;  ///< vertices that refinement for it took; none: it was not asked for
};

/// A file that was written with the report.
struct ReportFile {
  std::string path;
  std::string sha256;  ///< of its bytes, 64 digits
};

/// A report; what is absent or empty is left out of every form.
struct Report {
  std::string version;  ///< of scantet
  std::optional<ReportInput> input;
  std::optional<std::vector<ReportOption>> options;  ///< resolved, in the order of declaration
  std::optional<std::string> stop;                   ///< "converged", "limit", "time" or "memory"
  std::optional<LimitReport> limit;
  std::optional<ReportTheory> theory;           ///< none if all is proven
  std::optional<DroppedComponents> components;  ///< if the user chose among them
  std::optional<ReportMesh> mesh;
  std::optional<QualitySummary> quality;
  std::optional<RefinementCounts> rules;  ///< unmet: the elements of the finished mesh
  std::vector<ReportBound> bounds;        ///< all that were asked for; the mesh as it is now
  std::optional<ReportShortEdges> short_edges;
  std::optional<ReportOptimization> optimization;
  std::optional<AuditReport> audit;
  std::vector<std::string> notes;     ///< worth knowing: of the input, of what was chosen, of what is not checked
  std::vector<ReportRegion> regions;  ///< of the mesh and of the grid that it was made from, ascending
  std::optional<LayerCheck> layers;   ///< if layers were asked for
  std::optional<BoundaryDistance> distance;       ///< between the boundaries of the mesh and its domain
  std::optional<ReportCertificate> certificate;   ///< if it was asked for
  std::vector<ReportField> fields;                ///< that the mesh carries, in the order asked for
  std::optional<ReportSecondOrder> second_order;  ///< if the files have such elements
  std::optional<ReportTiming> timing_s;
  std::optional<ReportScan> scan;    ///< what the page shows beside the mesh; in no other form
  std::vector<ReportFile> files;     ///< of the same run: if all are as listed, the set is whole
  std::vector<StageAccount> stages;  ///< what timing_s.sample and timing_s.refine were spent on, in order
  std::vector<PhaseAccount> phases;  ///< what timing_s.read, audit and write were spent on, in order
};

/// The counts of a mesh; its volumes and regions are those of `quality`, which is of that mesh.
ReportMesh report_mesh(const TetMesh& mesh, const QualitySummary& quality);

/// Every option with the value it has now, in the order of declaration: flags, numbers and whole numbers as such, lists
/// as lists, the rest as text; null without a value. Of a repeatable number that was given once: the number, as if it
/// could not be repeated.
std::vector<ReportOption> report_options(const OptionSet& options);

/// What write_report can write: ".json", ".csv", ".html", ".svg", ".png". docs/reports.md says what each holds. Valid
/// for ever.
const std::vector<std::string>& report_extensions();

/// Writes one report, or several side by side, in the form that the extension of `path` names (upper or lower case),
/// whole or not at all. meshes: what each report is of, for the view in the .html page; as many as reports, and none
/// needed for other forms. set, difference: for callers within the library; null: the file appears at once, and meshes
/// are not compared. A .html page has `quality` and `mesh` of each report, found from its mesh if the report lacks
/// them. Throws Error: usage.format (unknown extension), output.cannot_write, output.full, output.stream (a fault of
/// ours), internal.chart (.svg and .png: the drawing library fails), mesh.inconsistent and mesh.facet (.html: a mesh
/// that is none). The file is as it was then.
void write_report(std::span<const Report> reports, std::span<const TetMesh> meshes, const std::string& path,
                  FileSet* set = nullptr, const ReportDifference* difference = nullptr);

}  // namespace scantet
