// Reading guards against broken files; here the parts are only called in order.
#include "scantet/app/mesh_tools.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scantet/app/order_step.h"
#include "scantet/app/outputs.h"
#include "scantet/base/error.h"
#include "scantet/base/mesh_order.h"
#include "scantet/base/name_list.h"
#include "scantet/base/options.h"
#include "scantet/base/phase_clock.h"
#include "scantet/base/stopwatch.h"
#include "scantet/base/version.h"
#include "scantet/check/audit.h"
#include "scantet/io/file_set.h"
#include "scantet/io/input_files.h"
#include "scantet/io/mesh_io.h"
#include "scantet/io/mesh_losses.h"
#include "scantet/quality/measures.h"
#include "scantet/quality/quality.h"
#include "scantet/quality/tet_stars.h"
#include "scantet/second_order/second_order.h"

namespace scantet {

namespace {

// Refuses a mesh that can be read and converted but is too large to be measured.
void check_coordinates(const std::string& file, const TetMesh& mesh) {
  for (const Point& p : mesh.vertices) {
    const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (largest <= kLargestCoordinateMm) continue;
    throw Error(Fault::input, "input.bad_mesh",
                file + ": a coordinate of " + number_text(largest, 3) + " mm is too large to measure with",
                "check the unit; it must be mm");
  }
}

ReportSecondOrder measured_second_order(const TetMesh& mesh) {
  const SecondOrderCounts counts = measure_second_order(mesh);
  return {counts.edges, counts.boundary_edges, {}, {}, {}, counts.unproved, counts.least_share, counts.volume_mm3};
}

}  // namespace

Report report_on_mesh(const std::string& file, double wave_speed_m_per_s, TetMesh& mesh, Progress& progress,
                      MeshBeside* beside) {
  Report report;
  ReportTiming timing;
  const Stopwatch total;
  PhaseClock phase(report.phases, progress);
  phase.begin("read", "mesh");
  MeshBeside rest;
  mesh = read_mesh(file, rest.left_out);
  check_coordinates(file, mesh);
  if (!mesh.tet_edge_vertices.empty()) {
    report.second_order = measured_second_order(mesh);
    rest.second_order = std::exchange(mesh, first_order(mesh));
  }
  if (beside != nullptr) *beside = std::move(rest);
  report.version = kVersion;
  phase.begin("read", "checksum");
  report.input = ReportInput{file, input_sha256({file}), std::nullopt};
  timing.read = total.seconds();

  phase.begin("audit", "measures");
  const Stopwatch auditing;
  AuditOptions options;
  options.restricted_delaunay = false;
  const TetStars stars(mesh);
  report.quality = measure_quality(mesh, nullptr, nullptr, &stars);
  report.quality->set_wave_speed(wave_speed_m_per_s);
  report.mesh = report_mesh(mesh, *report.quality);
  phase.end();
  options.progress = &progress;
  options.stars = &stars;
  report.audit = audit(mesh, nullptr, options);
  report.phases.insert(report.phases.end(), report.audit->phases.begin(), report.audit->phases.end());
  if (report.audit->complete) report.regions = report_regions(mesh, *report.quality, *report.audit);
  timing.audit = auditing.seconds();
  timing.total = total.seconds();
  report.timing_s = timing;
  return report;
}

MeshFindings report_on_meshes(const std::vector<std::string>& files, const std::vector<std::string>& reports,
                              Progress& progress, double wave_speed_m_per_s) {
  MeshFindings found;
  std::vector<TetMesh> meshes;
  check_outputs({}, reports, files);
  for (const std::string& file : files) {
    found.reports.push_back(report_on_mesh(file, wave_speed_m_per_s, meshes.emplace_back(), progress));
    const std::string prefix = files.size() > 1 ? file + ": " : "";
    for (const Finding& finding : found.reports.back().audit->findings) {
      found.findings.push_back(prefix + finding.message + "; " + finding.remedy);
    }
    if (const std::uint64_t others = meshes.back().other_solids; others > 0) {
      found.findings.push_back(prefix + other_solids_text(others) + ", not among what is measured; cut them into tets");
    }
    const auto& second = found.reports.back().second_order;
    if (second && second->unproved > 0) found.findings.push_back(prefix + unproved_text(second->unproved));
    if (!progress.cancelled()) continue;
    MeshFindings cancelled;
    cancelled.cancelled = true;
    return cancelled;
  }
  FileSet set;
  for (const std::string& file : reports) write_report(found.reports, meshes, file, &set);
  set.commit();
  found.written = reports;
  return found;
}

std::optional<std::vector<std::string>> convert_mesh(const std::string& from, const std::string& to, Space space,
                                                     Progress& progress, const std::vector<std::string>& also_read) {
  std::vector<std::string> read{from};
  read.insert(read.end(), also_read.begin(), also_read.end());
  check_outputs({to}, {}, read, {}, "");
  progress.report({"read", {}, 0, std::nullopt, 0});
  std::vector<std::string> left_out;
  const TetMesh mesh = read_mesh(from, left_out);
  if (progress.cancelled()) return std::nullopt;
  progress.report({"write", {}, 0, std::nullopt, 0});
  MeshWriteOptions how;
  how.ras = space == Space::ras;
  how.provenance = std::string("scantet ") + kVersion + " convert";
  write_mesh(mesh, to, how);
  constexpr bool kWithNames = true;
  const std::string unread = name_list(left_out, kShownUnread);
  std::vector<std::string> notes{unread.empty() ? "" : from + " has what is not read: " + unread,
                                 loss_text(mesh, to, kWithNames)};
  std::erase(notes, "");
  return notes;
}

}  // namespace scantet
