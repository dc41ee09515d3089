// --certify: the mesh that a job has written, verified against the scan that is read again.
#pragma once

#include <memory>
#include <string>

#include "scantet/app/job_result.h"
#include "scantet/app/mesh_job.h"
#include "scantet/app/meshing.h"
#include "scantet/base/api.h"
#include "scantet/io/file_set.h"
#include "scantet/plugin/plugin_registry.h"
#include "scantet/verification/verify_job.h"

namespace SCANTET_PROGRAM_API scantet {

/// Verifies the meshes of a job. What it is of is taken from the options that the job's input was opened with.
class Certifier {
 public:
  /// plugin: of this name, among these, opened the input, with these options. `plugins` must outlive this. Throws
  /// Error: usage.certify (what is meshed cannot be verified, or no mesh file is written that can be read again).
  Certifier(const MeshJob& job, const PluginRegistry& plugins, const std::string& plugin, const OptionSet& of_plugin);

  /// Finds the middles of facets without a collar; null if the job does not ask for refinement.
  FaultSearch search();
  /// What the refinement took.
  void note_refinement(const Meshing& meshing);
  /// Reads the first mesh file of the set that can be read back, as it is under its temporary name, verifies it, puts
  /// the outcome into the report and its certificate into the set. A grade below the one asked for becomes a finding.
  /// mesh: what was written. Return: false if cancelled. Throws Error: as read_mesh(), read_scan(), verify_mesh().
  bool certify(FileSet& set, const TetMesh& mesh, JobResult& result, Progress& progress);

 private:
  void take_labels(const MeshJob& job, const OptionSet& of_plugin);
  const VerifiedObject& object(Progress& progress);

  VerifyJob job_;
  bool refines_ = false;
  std::string certificate_file_;
  std::vector<std::string> pages_;  // and other reports
  std::optional<VerifiedObject> object_;
  std::optional<std::uint64_t> points_added_;
};

/// Whether one of these reports is a page.
bool has_page(const std::vector<std::string>& reports);

/// Checks that these reports of a verification, and its certificate, can be written, as check_outputs() does.
void check_reports(const VerifyJob& job, const std::vector<std::string>& reports);

/// Writes reports of a mesh that was verified: its measures and audit as report_on_mesh() gives them, the certificate,
/// and in a page the scan, too. Both files are read again. job.options.lists_facets: has_page(reports). Return: the
/// files; none if cancelled. Throws Error: as report_on_mesh(), read_scan(), write_report().
std::vector<std::string> report_on_verification(const VerifyJob& job, VerifyOutcome& outcome,
                                                const std::vector<std::string>& reports, Progress& progress);

}  // namespace scantet
