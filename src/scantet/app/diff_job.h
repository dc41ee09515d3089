// The job of `scantet diff`: one mesh file against another.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/options.h"
#include "scantet/base/progress.h"

namespace SCANTET_PROGRAM_API scantet {

/// What is compared, and what counts as the same.
struct DiffJob {
  std::string first;   ///< mesh file
  std::string second;  ///< mesh file
  double tolerance_mm = 0;
  double field_tolerance = 0;        ///< as a share of a field's greatest magnitude
  std::vector<std::string> reports;  ///< files, form by extension
  std::uint64_t threads = 0;

  /// Declares all but the files, which are arguments.
  void declare_options(OptionSet& set);
};

/// How it went.
struct DiffOutcome {
  bool cancelled = false;  ///< nothing was written; the rest is empty
  bool is_same = false;    ///< within the tolerance
  std::string text;        ///< for people, lines
  std::vector<std::string> written;
};

/// Reads both meshes, measures and compares them, and writes the reports. Files of the same bytes are only read once,
/// and not measured unless a report is asked for. Throws Error: usage.* and output.* (reports), input.* as read_mesh().
DiffOutcome run_diff(const DiffJob& job, Progress& progress);

}  // namespace scantet
