// --certify: the mesh that a job has written, verified against the scan that is read again.
#pragma once

#include <memory>
#include <string>

#include "scantet/app/job_result.h"
#include "scantet/app/mesh_job.h"
#include "scantet/app/meshing.h"
#include "scantet/io/file_set.h"
#include "scantet/verification/verify_job.h"

namespace scantet {

/// Verifies the meshes of a job. What it is of is taken from the options that the job's input was opened with.
class Certifier {
 public:
  /// plugin: that opened the input, with these options. Throws Error: usage.certify (what is meshed cannot be verified,
  /// or no mesh file is written that can be read again).
  Certifier(const MeshJob& job, const std::string& plugin, const OptionSet& of_plugin);

  /// Finds the middles of facets without a collar; null if the job does not ask for refinement.
  FaultSearch search();
  /// What the refinement took.
  void note_refinement(const Meshing& meshing);
  /// Reads the first mesh file of the set that can be read back, as it is under its temporary name, verifies it, puts
  /// the outcome into the report and its certificate into the set. A grade below the one asked for becomes a finding.
  /// mesh: what was written. Return: false if cancelled. Throws Error: as read_mesh(), read_scan(), verify_mesh().
  bool certify(FileSet& set, const TetMesh& mesh, JobResult& result, Progress& progress);

 private:
  const Scan& scan(Progress& progress);

  VerifyJob job_;
  bool refines_ = false;
  std::string certificate_file_;
  std::vector<std::string> pages_;  // and other reports
  std::optional<Scan> scan_;
  std::optional<std::uint64_t> points_added_;
};

}  // namespace scantet
