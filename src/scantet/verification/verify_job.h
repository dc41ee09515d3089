// The job of `scantet verify`: a mesh file against a scan file.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/options.h"
#include "scantet/base/progress.h"
#include "scantet/base/triangle_surface.h"
#include "scantet/certificate/certificate_text.h"
#include "scantet/field/grid_field.h"
#include "scantet/scan_input/component_options.h"
#include "scantet/scan_input/handle_option.h"
#include "scantet/scan_input/label_input.h"
#include "scantet/scan_input/simplify_options.h"
#include "scantet/verify/verify.h"

namespace SCANTET_PROGRAM_API scantet {

/// What a mesh is held against.
struct VerifiedObject {
  GridField field;                         ///< of no meaning if there is a surface
  std::optional<TriangleSurface> surface;  ///< whose inside the mesh is to be
};

/// What is asked of a mesh.
struct VerifyJob {
  std::string mesh;      ///< file
  std::string against;   ///< the scan, as read_scan() takes it, or what read_object() reads
  std::string grid;      ///< of a file that has several; empty: the only one
  bool repairs = false;  ///< of a surface: repaired first, as scantet mesh --repair does
  /// Reads `against` if it is no image; null: it is one.
  std::function<VerifiedObject(const VerifyJob& job, Progress& progress)> read_object;
  std::vector<double> levels;
  LabelOptions
      labels;  ///< if any() is true, the scan is a label map, and there are no levels; nor are there of a surface
  VerifyOptions options;
  std::optional<double> outside;
  CertificateGrade require = CertificateGrade::certified;
  std::string json;  ///< file for the certificate; empty: none
  std::uint64_t threads = 0;
  SimplifyOptions simplify;
  HandleOption handles;
  ComponentOptions components;  ///< what may be left out
  bool is_capped = false;       ///< --border cap

  std::string certificate;        ///< file of a certificate that is checked again; empty: none
  std::vector<std::string> read;  ///< files that were read for the job beside these: no output replaces them

  /// Declares all but the mesh, which is an argument.
  void declare_options(OptionSet& set);
};

/// How it went.
struct VerifyOutcome {
  bool cancelled = false;  ///< nothing was written; the rest is empty
  MeshCertificate certificate;
  bool is_as_required = false;  ///< the grade is at least the one that was asked for
  std::string text;             ///< for people, lines
};

/// The job that a certificate's file (job.certificate) records, with what `given` sets on top of it; the mesh and the
/// scan are those recorded unless the job names others. Throws Error: usage.*, input.certificate, input.cannot_open.
VerifyJob recorded_job(const VerifyJob& job, const std::vector<OptionValue>& given);

/// All files that the outputs of the job must not replace.
std::vector<std::string> files_read(const VerifyJob& job);

/// Reads both files, verifies the mesh (of second order: first_order() of it, and says so) and writes the certificate.
/// If there is one to be checked, the outcome is as required if both files are those that it names and the grade is the
/// one that it says. Throws Error: usage.level, usage.labels, usage.against, and as read_mesh(), read_scan(),
/// verify_mesh() and check_writable() do.
VerifyOutcome run_verify(const VerifyJob& job, Progress& progress);

/// The scan of the job, as simple as it says, or the surface. Throws Error: as read_scan() and read_object(),
/// usage.grid, usage.repair, usage.crop, usage.level (a scan without), usage.surface (a surface with a level);
/// without_thin_handles().
VerifiedObject object_to_verify(const VerifyJob& job, Progress& progress);

/// Verifies a mesh in memory against that. If cancelled, the outcome means nothing. Throws Error: as
/// verify_mesh(), verify_labels() or verify_surface(); input.background (the field beyond a label map is a label);
/// usage.value
/// (--components); as label_settings().
MeshCertificate verify_against(const VerifyJob& job, const TetMesh& mesh, const VerifiedObject& object,
                               Progress& progress);

}  // namespace scantet
