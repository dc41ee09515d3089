// What was promised is checked from scratch on the finished mesh, with nothing taken over from the engine's books.
#include "scantet/app/job_report.h"

#include <algorithm>
#include <cmath>

#include "scantet/app/region_notes.h"
#include "scantet/base/phase_clock.h"
#include "scantet/check/audit.h"
#include "scantet/check/conformance.h"
#include "scantet/quality/tet_stars.h"

namespace scantet {
namespace {

ReportOptimization report_optimization(const Meshing& meshing, double target_deg) {
  ReportOptimization report;
  report.target_deg = target_deg;
  report.tets_below = meshing.conformance.min_dihedral.count;
  report.stages = meshing.optimized.stages;
  report.finer_places = meshing.finer.size();
  for (const FinerPlace& place : meshing.finer) {
    report.smallest_size_mm = std::min(report.smallest_size_mm.value_or(place.size_mm), place.size_mm);
  }
  return report;
}

// A budget that is used up has a finding of its own.
void find_limit(const MeshResult& mesh, const MesherOptions& options, const Budget& budget, JobResult& result) {
  if (mesh.stop == Stop::limit && !budget.out_of_budget()) {
    std::string text = "refinement stopped at --max-vertices " + std::to_string(options.max_vertices);
    if (mesh.limit && mesh.limit->insertion_radius_mm > 0) {  // else no rule was busy yet
      const Point& p = mesh.limit->place;
      text += " while " + mesh.limit->rule + " kept firing, last at (" + number_text(p.x, 6) + ", " +
              number_text(p.y, 6) + ", " + number_text(p.z, 6) + ") mm, " +
              number_text(mesh.limit->insertion_radius_mm, 3) + " mm from the next vertex";
    }
    result.findings.push_back(text + "; allow more vertices, choose a larger --size, or loosen the bounds");
  }
}

const char* stop_word(const MeshResult& mesh, const Budget& budget) {
  switch (budget.end()) {
    case Budget::End::time:
      return "time";
    case Budget::End::memory:
      return "memory";
    default:
      return mesh.stop == Stop::limit ? "limit" : "converged";
  }
}

/// Collects bounds for a report.
class BoundList {
 public:
  /// options: those that ask for it; with the number asked for behind, if it is one's.
  void add(const char* name, const char* what, const std::string& options, bool is_least, double asked,
           const BrokenBound& broken, std::uint64_t of) {
    bounds_.push_back({name, what, options, is_least, asked, broken.count, of, std::nullopt, std::nullopt});
    if (broken.count == 0) return;
    bounds_.back().worst = broken.worst;
    bounds_.back().place = broken.place;
  }
  /// Of an option that gives the bound itself.
  void add_given(const char* name, const char* what, const char* option, bool is_least, std::optional<double> asked,
                 const BrokenBound& broken, std::uint64_t of) {
    if (asked) add(name, what, std::string(option) + " " + number_text(*asked), is_least, *asked, broken, of);
  }
  std::vector<ReportBound> take() { return std::move(bounds_); }

 private:
  std::vector<ReportBound> bounds_;
};

/// The parts of a boundary that are not proved to keep the limit, as elements that break a bound. What is undecided is
/// as far as can be.
BrokenBound broken_bound(const OneWayDistance& distance, double limit_mm) {
  BrokenBound broken{distance.beyond.size(), 0, {}};
  for (const FarPlace& place : distance.beyond) {
    if (place.distance_mm >= broken.worst) broken.worst = place.distance_mm, broken.place = place.point;
  }
  if (broken.worst <= limit_mm) broken.worst = distance.upper_mm.value_or(broken.worst);
  return broken;
}

/// way: what is measured, for people. That a limit is broken is only said where some point breaks it.
std::string limited_text(const std::string& way, const OneWayDistance& distance) {
  const bool is_open = distance.undecided > 0 && distance.undecided == distance.beyond.size();
  return is_open ? way + ", not proved to be within the limit, perhaps" : way;
}

void add_distances(const BoundaryDistance& d, BoundList& list) {
  if (!d.limit_mm) return;
  const std::string option = "--max-distance " + number_text(*d.limit_mm);
  list.add("max_distance_to_mesh_mm", limited_text("surface to mesh, mm", d.to_mesh).c_str(), option, false,
           *d.limit_mm, broken_bound(d.to_mesh, *d.limit_mm), d.to_mesh.parts);
  list.add("max_distance_to_surface_mm", limited_text("mesh to surface, mm", d.to_domain).c_str(), option, false,
           *d.limit_mm, broken_bound(d.to_domain, *d.limit_mm), d.to_domain.parts);
}

/// edge: what is asked of edges, of which there are so many.
std::vector<ReportBound> report_bounds(const Conformance& c, const BoundaryDistance& distance, const MeshJob& job,
                                       bool tets_have_sizes, const std::optional<EdgeTarget>& edge,
                                       std::uint64_t edges) {
  constexpr bool kLeast = true;
  constexpr bool kMost = false;
  BoundList list;
  list.add_given("min_dihedral_deg", "dihedral angle, degrees", "--min-dihedral", kLeast, job.min_dihedral_deg,
                 c.min_dihedral, c.tets);
  list.add_given("max_dihedral_deg", "dihedral angle, degrees", "--max-dihedral", kMost, job.max_dihedral_deg,
                 c.max_dihedral, c.tets);
  list.add_given("min_scaled_jacobian", "scaled Jacobian", "--min-scaled-jacobian", kLeast, job.min_scaled_jacobian,
                 c.scaled_jacobian, c.tets);
  list.add_given("facet_radius_edge", "R1: radius-edge ratio of facets", "--facet-radius-edge", kMost,
                 job.mesher.bounds.facet_radius_edge, c.facet_radius_edge, c.facets);
  list.add("facet_size_ratio", "R2: surface ball / (alpha x size)", "--size or --alpha", kMost, 1, c.facet_size,
           c.facets);
  list.add_given("facet_distance_mm", "R2: facet to surface, mm", "--facet-distance", kMost,
                 job.mesher.bounds.facet_distance_mm, c.facet_distance, c.facets);
  if (tets_have_sizes) {
    list.add("tet_size_ratio", "R3: circumradius / size of tets", "--size", kMost, 1, c.tet_size, c.tets);
  }
  list.add_given("tet_radius_edge", "R3: radius-edge ratio of tets", "--cell-radius-edge", kMost,
                 job.mesher.bounds.cell_radius_edge, c.tet_radius_edge, c.tets);
  add_distances(distance, list);
  if (job.min_edge.empty() || !edge) return list.take();
  const bool is_share = edge->share > 0;
  list.add(is_share ? "min_edge_share" : "min_edge_mm", is_share ? "edge length / size" : "edge length, mm",
           "--min-edge " + job.min_edge, kLeast, is_share ? edge->share : edge->mm, c.min_edge, edges);
  return list.take();
}

/// Cancelled by who watches alone: a mesh that a budget has ended is checked as others are.
class Watcher final : public Progress {
 public:
  explicit Watcher(const Budget& budget) : budget_(budget) {}
  bool cancelled() const override { return budget_.end() == Budget::End::cancelled; }

 private:
  const Budget& budget_;
};

/// The layers across thin parts, a bound as others: counted unless they are known, or it is cancelled. option: as it
/// was given.
void add_layers(const Meshing& meshing, const LayerSettings& asked, const std::string& option, const Budget& budget,
                Report& report) {
  report.layers = meshing.layers;
  if (!report.layers) {
    report.layers = check_layers(meshing.refined.mesh, asked.regions, asked.layers, asked.thinnest_mm, Watcher(budget));
  }
  if (!report.layers) return;
  ReportBound bound{"min_layers", "layers of tets across", "--layers " + option, true, double(asked.layers)};
  bound.of = report.layers->vertices;
  bound.broken = report.layers->broken;
  if (!report.layers->places.empty()) {
    bound.worst = report.layers->places.front().layers;
    bound.place = report.layers->places.front().place;
  }
  report.bounds.push_back(std::move(bound));
}

/// limited: refinement was stopped, so that nothing was improved.
std::string remedy_of(const ReportBound& bound, bool limited) {
  if (limited) return "let refinement end";
  const bool of_size = bound.options.starts_with("--size");
  return std::string(of_size ? "" : "choose a smaller --size or ") + "loosen " + bound.options;
}

/// None if nothing is asked of edges.
std::optional<ReportShortEdges> report_short_edges(const Conformance& c, const MeshJob& job,
                                                   const std::optional<EdgeTarget>& target, std::uint64_t edges) {
  if (!target) return std::nullopt;
  const std::string than =
      target->share > 0 ? number_text(100 * target->share) + "% of the size" : number_text(target->mm) + " mm";
  return ReportShortEdges{than, !job.min_edge.empty(), c.min_edge.count, edges, c.short_edges};
}

/// Edges that nobody has asked about are no fault.
void note_short_edges(const ReportShortEdges& edges, JobResult& result) {
  if (edges.is_bound || edges.count == 0) return;
  result.notes.push_back(
      short_edges_text(edges) +
      ": the surface is too narrow there for longer ones (islands and cavities smaller than that go with "
      "--min-component and --fill-cavities); --min-edge makes it a bound");
}

/// Where the surface is narrower than the size, points that keep its topology are closer to each other.
void note_least_size(double least_mm, const QualitySummary& quality, JobResult& result) {
  constexpr double kShort = 0.1;  // of the least size
  if (!(quality.edge_length_mm.min < kShort * least_mm)) return;
  const std::string text = "edges are as short as " + number_text(quality.edge_length_mm.min, 3) +
                           " mm, far under --least-size " + number_text(least_mm) +
                           ": where the surface is narrower than the size, its topology takes such edges";
  result.notes.push_back(text + "; without small components (--min-component) there are fewer");
}

/// Audits the mesh and lists its regions.
void audit_mesh(const TetMesh& mesh, const OpenedDomain& opened, AuditOptions options, Budget& budget,
                std::optional<RegionGrid> grid, JobResult& result) {
  Report& report = result.report;
  if (opened.grid && !grid) {
    PhaseClock phase(report.phases, budget);
    phase.begin("audit", "regions of the input");
    grid = opened.grid();
  }
  if (grid) options.grid = &*grid;
  report.audit = audit(mesh, opened.domain.get(), options);
  report.phases.insert(report.phases.end(), report.audit->phases.begin(), report.audit->phases.end());
  if (!report.audit->complete) return;
  report.regions = report_regions(mesh, *report.quality, *report.audit, opened.colors,
                                  grid ? std::abs(grid->frame.determinant_mm3()) : 0);
  const std::vector<std::string> notes = notes_on_regions(report.regions, *report.audit);
  result.notes.insert(result.notes.end(), notes.begin(), notes.end());
}

/// The audit knows whose handles are not the domain's; where they were lost or made, as far as meshing has seen it.
void place_handles(const std::vector<Point>& places, AuditReport& audit) {
  constexpr std::size_t kListed = 1000;
  if (places.empty()) return;
  for (Finding& finding : audit.findings) {
    if (finding.code != "audit.handles") continue;
    finding.where = places.front();
    finding.places.assign(places.begin(),
                          places.begin() + static_cast<std::ptrdiff_t>(std::min(places.size(), kListed)));
  }
}

/// How many there are, and the first; of at least one.
std::string counted_places(const std::vector<Point>& places, const char* word) {
  const Point& p = places.front();
  return std::to_string(places.size()) + " " + word + ", the first at (" + number_text(p.x, 4) + ", " +
         number_text(p.y, 4) + ", " + number_text(p.z, 4) + ") mm";
}

/// Notes where the mesh is not quite what was asked for, and is so on purpose.
void note_deviations(const Meshing& meshing, JobResult& result) {
  const MeshResult& mesh = meshing.refined;
  if (mesh.is_noise) {
    result.notes.push_back(
        "at this level and size the scan is noise: narrow places are all over, more than tets of the "
        "size can show, and its topology was not mended; try another --level, --smooth or --median, "
        "or a smaller --size");
  }
  if (mesh.counts.absorbed_tets > 0) {
    result.notes.push_back(std::to_string(mesh.counts.absorbed_tets) +
                           " tets in fragments smaller than the size, where the surface is pinched, changed sides" +
                           (mesh.is_beyond_mending && !mesh.is_noise
                                ? "; these are so many that nothing was refined for their sake: the "
                                  "scan is too rough for this size"
                                : ""));
  }
  if (!mesh.thin_sheets.empty()) {
    result.notes.push_back("there is a sheet thinner than a tenth of the size, or a gap as thin: " +
                           counted_places(mesh.thin_sheets, "places") +
                           "; it is left torn, as no elements of the size show it: leave it out (--min-component, if "
                           "it is apart; --crop), try another --level or less --smooth, or a far smaller --size");
  }
  if (!mesh.merged_curves.empty()) {
    result.notes.push_back("curves that the mesh follows come too close to each other for the size at " +
                           counted_places(mesh.merged_curves, "points") + ": there the mesh has one");
  }
  if (!mesh.exchanged_handles.empty()) {
    result.notes.push_back("there are as many handles as in the scan, but perhaps one for another, at " +
                           counted_places(mesh.exchanged_handles, "places") +
                           ": look there, or mesh with a smaller --size");
  }
  if (!mesh.wrong_handles.empty()) {
    result.notes.push_back("handles seem to be lost or made at " + counted_places(mesh.wrong_handles, "places"));
  }
  if (!meshing.finer.empty()) {
    result.notes.push_back("the size was made finer at " + std::to_string(meshing.finer.size()) + " places, down to " +
                           number_text(*result.report.optimization->smallest_size_mm, 3) +
                           " mm, where elements would have stayed out of bounds or the surface tangled");
  }
}

}  // namespace

void inspect(const Meshing& meshing, const OpenedDomain& opened, const ChosenSize& chosen, const MeshJob& job,
             Budget& budget, std::optional<RegionGrid> grid, JobResult& result) {
  const Domain& domain = *opened.domain;
  const std::shared_ptr<const SizingField>& asked = chosen.field;
  const FinerSize size(asked, meshing.finer);
  const MeshResult& mesh = meshing.refined;
  Report& report = result.report;
  report.stop = stop_word(mesh, budget);
  report.limit = mesh.limit;
  report.stages = mesh.stages;
  report.rules = mesh.counts;
  report.rules->unmet = meshing.conformance.unmet;
  PhaseClock phase(report.phases, budget);
  phase.begin("audit", "distance");
  report.distance =
      meshing.distance ? *meshing.distance : measure_distance(mesh.mesh, domain, {.limit_mm = {}, .size = &size});
  phase.end();
  if (job.min_dihedral_deg) {
    report.optimization = report_optimization(meshing, job.min_dihedral_deg.value_or(0));
  }
  phase.begin("audit", "measures");
  const TetStars stars(mesh.mesh);
  report.quality = measure_quality(mesh.mesh, size.bounds_tets() ? &size : nullptr, asked.get(), &stars);
  report.mesh = report_mesh(mesh.mesh, *report.quality);
  const std::uint64_t edges = report.quality->edge_length_mm.count;
  const std::optional<EdgeTarget> edge = job.edge_target(*asked);
  report.bounds = report_bounds(meshing.conformance, *report.distance, job, size.bounds_tets(), edge, edges);
  if (chosen.layers) add_layers(meshing, *chosen.layers, job.sizes.layers, budget, report);
  report.short_edges = report_short_edges(meshing.conformance, job, edge, edges);
  phase.end();
  if (job.sizes.least_mm) note_least_size(*job.sizes.least_mm, *report.quality, result);
  if (report.short_edges) note_short_edges(*report.short_edges, result);
  find_limit(mesh, job.mesher, budget, result);
  AuditOptions audit_options;
  audit_options.restricted_delaunay = mesh.counts.absorbed_tets == 0 && meshing.optimized.stages.empty() &&
                                      domain.curves().empty();  // regions are those of orthocentres there
  audit_options.progress = &budget;
  audit_options.stars = &stars;
  audit_options.distance = &*report.distance;
  audit_options.size = asked.get();
  audit_mesh(mesh.mesh, opened, audit_options, budget, std::move(grid), result);
  place_handles(mesh.wrong_handles, *report.audit);
  note_deviations(meshing, result);
  for (const Finding& finding : report.audit->findings) {
    result.findings.push_back(finding.message + "; " + finding.remedy);
  }
  for (const ReportBound& bound : report.bounds) {
    if (bound.broken == 0) continue;
    result.findings.push_back(broken_text(bound) + "; " + remedy_of(bound, mesh.stop == Stop::limit));
  }
}

}  // namespace scantet
