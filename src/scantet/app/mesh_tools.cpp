// Reading guards against broken files; what is left to do here is to call the parts in order.
#include "scantet/app/mesh_tools.h"

#include "scantet/app/input_files.h"
#include "scantet/app/outputs.h"
#include "scantet/base/stopwatch.h"
#include "scantet/base/version.h"
#include "scantet/io/mesh_io.h"
#include "scantet/quality/audit.h"
#include "scantet/quality/quality.h"

namespace scantet {

JobResult report_on_mesh(const std::string& mesh_file, const std::vector<std::string>& reports, Progress& progress) {
  const Stopwatch total;
  JobResult result;
  ReportTiming timing;
  check_outputs({}, reports, {mesh_file});

  progress.report({"read", {}, 0, std::nullopt, 0});
  const Stopwatch reading;
  const TetMesh mesh = read_mesh(mesh_file);
  result.report.input = ReportInput{mesh_file, input_sha256({mesh_file}), std::nullopt};
  timing.read = reading.seconds();

  progress.report({"audit", {}, 0, std::nullopt, 0});
  const Stopwatch auditing;
  AuditOptions options;
  options.restricted_delaunay = false;
  result.report.quality = measure_quality(mesh);
  result.report.mesh = report_mesh(mesh, *result.report.quality);
  result.report.audit = audit(mesh, nullptr, options);
  timing.audit = auditing.seconds();
  for (const Finding& finding : result.report.audit->findings) {
    result.findings.push_back(finding.message + "; " + finding.remedy);
  }

  result.report.version = kVersion;
  timing.total = total.seconds();
  result.report.timing_s = timing;
  if (progress.cancelled()) {
    JobResult cancelled;
    cancelled.cancelled = true;
    return cancelled;
  }
  for (const std::string& file : reports) {
    write_report(result.report, file);
    result.written.push_back(file);
  }
  return result;
}

bool convert_mesh(const std::string& from, const std::string& to, Space space, Progress& progress) {
  check_outputs({to}, {}, {from});
  progress.report({"read", {}, 0, std::nullopt, 0});
  const TetMesh mesh = read_mesh(from);
  if (progress.cancelled()) return false;
  progress.report({"write", {}, 0, std::nullopt, 0});
  MeshWriteOptions how;
  how.ras = space == Space::ras;
  how.provenance = std::string("scantet ") + kVersion + " convert";
  write_mesh(mesh, to, how);
  return true;
}

}  // namespace scantet
