// Fields of scans that a mesh is to carry, as people ask for them: --field density=ct.nrrd:mean.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/options.h"
#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/field/scan.h"
#include "scantet/fields/scan_field.h"
#include "scantet/places/scan_values.h"
#include "scantet/report/report.h"

namespace scantet {

/// A field that is asked for: NAME=SCAN[:mean|std|min|max|median|fraction=LABEL].
struct FieldRequest {
  std::string name;
  std::string scan;  ///< a path, as read_scan() takes it
  FieldChoice choice;
};

/// Throws Error: usage.field (text of another form, a name that files have already or that is there twice).
std::vector<FieldRequest> read_field_requests(const std::vector<std::string>& texts);

/// Declares --field. The target must outlive the set.
void declare_field_options(OptionSet& options, std::vector<std::string>& fields);

/// Scans for the fields of a job: read before there is a mesh, so that a wrong file costs no time.
class FieldScans {
 public:
  /// Reads each scan once, and those that are in `known` not again. A scan that shares nothing with the box around the
  /// object is refused. Throws Error: as read_field_requests() and read_scan(); input.field (it is elsewhere than the
  /// object).
  FieldScans(const std::vector<std::string>& texts, const Box& object, const ScanTable& known, Progress& progress);

  /// The files that were read.
  const std::vector<std::string>& files() const { return files_; }

  /// Puts the fields into the mesh, and tells of each in the report; notes: of those that reach beyond their scan.
  void add_to(TetMesh& mesh, Report& report, std::vector<std::string>& notes) const;

 private:
  std::vector<FieldRequest> requests_;
  std::vector<Scan> scans_;  ///< one a request
  std::vector<std::string> files_;
};

}  // namespace scantet
