// What was promised is checked from scratch on the finished mesh, with nothing taken over from the engine's books.
#include "scantet/app/inspection.h"

#include <algorithm>

#include "scantet/optimize/conformance.h"
#include "scantet/quality/audit.h"

namespace scantet {
namespace {

ReportRules report_rules(const MeshResult& mesh, const Conformance& conformance) {
  ReportRules rules;
  rules.initial_points = mesh.initial_points;
  rules.lattice_points = mesh.lattice_points;
  rules.repair_points = mesh.repair_points;
  rules.absorbed_tets = mesh.absorbed_tets;
  rules.r1 = mesh.inserted.r1;
  rules.r2 = mesh.inserted.r2;
  rules.r3_1 = mesh.inserted.r3_1;
  rules.r3_2 = mesh.inserted.r3_2;
  rules.unmet_r1 = conformance.r1;
  rules.unmet_r2 = conformance.r2;
  rules.unmet_r3 = conformance.r3;
  return rules;
}

ReportOptimization report_optimization(const Meshing& meshing, double target_deg) {
  ReportOptimization report;
  report.target_deg = target_deg;
  report.tets_below = meshing.conformance.min_dihedral.count;
  for (const OptimizerStage& s : meshing.optimized.stages) {
    report.stages.push_back({s.stage, s.seconds, s.changes, s.min_dihedral_before_deg, s.min_dihedral_after_deg});
  }
  report.finer_places = meshing.finer.size();
  for (const FinerPlace& place : meshing.finer) {
    report.smallest_size_mm = std::min(report.smallest_size_mm.value_or(place.size_mm), place.size_mm);
  }
  return report;
}

std::vector<ReportStage> report_stages(const std::vector<StageAccount>& accounts) {
  std::vector<ReportStage> stages;
  for (const StageAccount& account : accounts) stages.push_back({account.stage, account.seconds, account.points});
  return stages;
}

void find_limit(const MeshResult& mesh, const MesherOptions& options, JobResult& result) {
  if (mesh.stop == Stop::limit) {
    std::string text = "refinement stopped at --max-vertices " + std::to_string(options.max_vertices);
    if (mesh.limit) {
      const Point& p = mesh.limit->place;
      text += " while " + mesh.limit->rule + " kept firing, last at (" + number_text(p.x, 6) + ", " +
              number_text(p.y, 6) + ", " + number_text(p.z, 6) + ") mm, " +
              number_text(mesh.limit->insertion_radius_mm, 3) + " mm from the next vertex";
    }
    result.findings.push_back(text + "; allow more vertices, choose a larger --size, or loosen the bounds");
  }
}

/// What each bound is called, and which option asks for it.
std::vector<ReportBound> report_bounds(const Conformance& c, const MeshJob& job, bool tets_have_sizes) {
  std::vector<ReportBound> bounds;
  const auto add = [&](const char* name, const char* what, const char* options, bool is_least, double asked,
                       const BrokenBound& broken, std::uint64_t of) {
    bounds.push_back({name, what, options, is_least, asked, broken.count, of, std::nullopt, std::nullopt});
    if (broken.count == 0) return;
    bounds.back().worst = broken.worst;
    bounds.back().place = broken.place;
  };
  if (job.min_dihedral_deg) {
    add("min_dihedral_deg", "dihedral angles, degrees", "--min-dihedral", true, *job.min_dihedral_deg, c.min_dihedral,
        c.tets);
  }
  if (job.max_dihedral_deg) {
    add("max_dihedral_deg", "dihedral angles, degrees", "--max-dihedral", false, *job.max_dihedral_deg, c.max_dihedral,
        c.tets);
  }
  if (job.min_scaled_jacobian) {
    add("min_scaled_jacobian", "scaled Jacobian of tets", "--min-scaled-jacobian", true, *job.min_scaled_jacobian,
        c.scaled_jacobian, c.tets);
  }
  add("facet_radius_edge", "radius-edge ratio of facets (R1)", "--facet-radius-edge", false,
      job.mesher.facet_radius_edge, c.facet_radius_edge, c.facets);
  add("facet_size_ratio", "surface ball over alpha x size (R2)", "--size, --alpha", false, 1, c.facet_size, c.facets);
  if (job.mesher.facet_distance_mm) {
    add("facet_distance_mm", "facet to surface, mm (R2)", "--facet-distance", false, *job.mesher.facet_distance_mm,
        c.facet_distance, c.facets);
  }
  if (tets_have_sizes) {
    add("tet_size_ratio", "circumradius of tets over size (R3)", "--size", false, 1, c.tet_size, c.tets);
  }
  add("tet_radius_edge", "radius-edge ratio of tets (R3)", "--cell-radius-edge", false, job.mesher.cell_radius_edge,
      c.tet_radius_edge, c.tets);
  return bounds;
}

void find_broken(const ReportBound& bound, JobResult& result) {
  if (bound.broken == 0) return;
  const Point& p = *bound.place;
  result.findings.push_back(std::to_string(bound.broken) + " of " + std::to_string(bound.of) + ": " + bound.what +
                            (bound.is_least ? " under " : " over ") + number_text(bound.asked) + ", the worst with " +
                            number_text(*bound.worst, 3) + " at (" + number_text(p.x, 6) + ", " + number_text(p.y, 6) +
                            ", " + number_text(p.z, 6) + ") mm; choose a smaller --size or loosen " + bound.options);
}

}  // namespace

void inspect(const Meshing& meshing, const Domain& domain, const SizingField& size, const MeshJob& job,
             JobResult& result) {
  const MeshResult& mesh = meshing.refined;
  Report& report = result.report;
  report.stop = mesh.stop == Stop::limit ? "limit" : "converged";
  if (mesh.limit) report.limit = ReportLimit{mesh.limit->rule, mesh.limit->place, mesh.limit->insertion_radius_mm};
  report.stages = report_stages(mesh.stages);
  report.rules = report_rules(mesh, meshing.conformance);
  report.bounds = report_bounds(meshing.conformance, job, size.bounds_tets());
  if (job.min_dihedral_deg) {
    report.optimization = report_optimization(meshing, job.min_dihedral_deg.value_or(0));
  }
  report.quality = measure_quality(mesh.mesh, size.bounds_tets() ? &size : nullptr);
  report.mesh = report_mesh(mesh.mesh, *report.quality);
  find_limit(mesh, job.mesher, result);
  AuditOptions audit_options;
  audit_options.restricted_delaunay = mesh.absorbed_tets == 0 && meshing.optimized.stages.empty();
  report.audit = audit(mesh.mesh, &domain, audit_options);
  if (mesh.absorbed_tets > 0) {
    result.notes.push_back(std::to_string(mesh.absorbed_tets) +
                           " tets in fragments smaller than the size, where the surface is pinched, changed sides");
  }
  if (!meshing.finer.empty()) {
    result.notes.push_back("the size was made finer at " + std::to_string(meshing.finer.size()) + " places, down to " +
                           number_text(*report.optimization->smallest_size_mm, 3) +
                           " mm, where elements would have stayed out of bounds or the surface tangled");
  }
  for (const Finding& finding : report.audit->findings) {
    result.findings.push_back(finding.message + "; " + finding.remedy);
  }
  for (const ReportBound& bound : report.bounds) find_broken(bound, result);
}

}  // namespace scantet
