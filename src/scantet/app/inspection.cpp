// What was promised is checked from scratch on the finished mesh, with nothing taken over from the engine's books.
#include "scantet/app/inspection.h"

#include <algorithm>

#include "scantet/optimize/conformance.h"
#include "scantet/quality/audit.h"

namespace scantet {
namespace {

ReportRules report_rules(const MeshResult& mesh, const UnmetRules& unmet) {
  ReportRules rules;
  rules.initial_points = mesh.initial_points;
  rules.lattice_points = mesh.lattice_points;
  rules.repair_points = mesh.repair_points;
  rules.absorbed_tets = mesh.absorbed_tets;
  rules.r1 = mesh.inserted.r1;
  rules.r2 = mesh.inserted.r2;
  rules.r3_1 = mesh.inserted.r3_1;
  rules.r3_2 = mesh.inserted.r3_2;
  rules.unmet_r1 = unmet.r1;
  rules.unmet_r2 = unmet.r2;
  rules.unmet_r3 = unmet.r3;
  return rules;
}

ReportOptimization report_optimization(const Meshing& meshing, double target_deg) {
  ReportOptimization report;
  report.target_deg = target_deg;
  report.tets_below = meshing.sharp.size();
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

ReportConformance report_conformance(const RuleConformance& c) {
  return {c.r1, c.r2, c.r3, c.facets, c.tets};
}

void find_unmet(const MeshResult& mesh, const MesherOptions& options, JobResult& result) {
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
  const ReportRules& rules = *result.report.rules;
  const auto unmet = [&](std::uint64_t count, const char* what) {
    if (count > 0) result.findings.push_back(std::to_string(count) + " " + what);
  };
  unmet(rules.unmet_r1,
        "boundary facets violate R1 (--facet-radius-edge, or a vertex off the boundary or on another surface)");
  unmet(rules.unmet_r2, "boundary facets violate R2 (--size, --alpha, --facet-distance)");
  unmet(rules.unmet_r3, "tets violate R3 (--size, --cell-radius-edge)");
}

void find_sharp(const Meshing& meshing, double target_deg, JobResult& result) {
  if (meshing.sharp.empty()) return;
  const WorstTet& worst = meshing.sharp.front();
  result.findings.push_back(std::to_string(meshing.sharp.size()) + " tets have a dihedral angle under --min-dihedral " +
                            number_text(target_deg) + ", the smallest of " + number_text(worst.value, 3) +
                            " degrees at (" + number_text(worst.place.x, 6) + ", " + number_text(worst.place.y, 6) +
                            ", " + number_text(worst.place.z, 6) +
                            ") mm; choose a smaller --size or a smaller --min-dihedral");
}

}  // namespace

void inspect(const Meshing& meshing, const Domain& domain, const SizingField& size, const MesherOptions& options,
             std::optional<double> min_dihedral_deg, JobResult& result) {
  const MeshResult& mesh = meshing.refined;
  Report& report = result.report;
  report.stop = mesh.stop == Stop::limit ? "limit" : "converged";
  if (mesh.limit) report.limit = ReportLimit{mesh.limit->rule, mesh.limit->place, mesh.limit->insertion_radius_mm};
  report.stages = report_stages(mesh.stages);
  if (min_dihedral_deg) report.optimization = report_optimization(meshing, *min_dihedral_deg);
  report.quality = measure_quality(mesh.mesh, size.bounds_tets() ? &size : nullptr);
  report.mesh = report_mesh(mesh.mesh, *report.quality);
  // From scratch, with nothing taken over from the engine's books.
  report.rules = report_rules(mesh, check_rules(mesh.sample, mesh.sample_on_boundary, domain, size, options));
  if (!meshing.optimized.stages.empty()) {
    const RuleBounds bounds{options.alpha, options.facet_radius_edge, options.cell_radius_edge,
                            options.facet_distance_mm};
    report.optimization->after = report_conformance(check_conformance(mesh.mesh, domain, size, bounds));
  }
  find_unmet(mesh, options, result);
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
                           " mm, where larger tets would have stayed too flat or the surface tangled");
  }
  for (const Finding& finding : report.audit->findings) {
    result.findings.push_back(finding.message + "; " + finding.remedy);
  }
  if (min_dihedral_deg) find_sharp(meshing, *min_dihedral_deg, result);
}

}  // namespace scantet
