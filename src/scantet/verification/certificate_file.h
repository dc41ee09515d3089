// A certificate as a file, and what it says.
#pragma once

#include <string>
#include <vector>

#include "scantet/verification/verify_job.h"

namespace scantet {

/// The certificate as JSON, with the checksums of both files, and of a table that --labels names, and the options that
/// say what was verified. mesh_file: where the mesh is now, if it is to take the name job.mesh later; empty: it has
/// that name.
std::string certificate_json(const MeshCertificate& certificate, const VerifyJob& job,
                             const std::string& mesh_file = "");

/// What such a file says was verified.
struct RecordedCertificate {
  std::string grade;
  std::string mesh;         ///< the file's name then
  std::string mesh_sha256;  ///< and its checksum
  std::string scan;
  std::string scan_sha256;
  std::string labels_sha256;         ///< of the table that --labels names; empty: it names none, or is not recorded
  std::vector<OptionValue> options;  ///< of VerifyJob
};

/// Throws Error: input.cannot_open, input.certificate.
RecordedCertificate read_certificate(const std::string& path);

/// The job's files, the table of labels among them, whose checksums are not those recorded.
std::vector<std::string> changed_files(const RecordedCertificate& recorded, const VerifyJob& job);

}  // namespace scantet
