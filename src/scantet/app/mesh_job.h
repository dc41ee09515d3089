// What `scantet mesh` is asked to do: every option of the job, declared once.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scantet/app/budget_options.h"
#include "scantet/app/mesh_request.h"
#include "scantet/app/model_options.h"
#include "scantet/base/api.h"
#include "scantet/base/options.h"
#include "scantet/quality/quality.h"

namespace SCANTET_PROGRAM_API scantet {

/// Orientation of the world axes in the files written.
enum class Space { lps, ras };

/// Whether the mesh is to be proved to be the scan's level set, and how far.
enum class Certify {
  no,
  bounded,    ///< the grade that is asked for
  certified,  ///< the grade that is asked for
  refine      ///< certified; and where facets have no collar, the mesh is made finer
};

/// A request, and where the object comes from and what is written.
struct MeshJob : MeshRequest {
  std::string input;                       ///< a path, as the plugins take it
  std::vector<OptionValue> input_options;  ///< for the plugin that opens the input, e.g. its level
  BudgetOptions budget;
  ModelOptions model;
  Space space = Space::lps;
  Certify certify = Certify::no;
  std::string certificate;           ///< file for the certificate; empty: none
  bool plan = false;                 ///< says what is to be expected, and meshes nothing
  bool no_theory = false;            ///< nothing said when the bounds are beyond what is proven
  std::vector<std::string> outputs;  ///< mesh files, format by extension; may be none
  std::vector<std::string> reports;  ///< report files, format by extension
  std::vector<std::string> fields;   ///< of scans, one a tet: NAME=SCAN[:MEASURE], as docs/fields.md says
  bool quality_fields = false;       ///< one field a measure of tets, too
  std::vector<std::string> read;     ///< files that were read for the job beside its input: no output replaces them
  std::vector<std::string> beside;   ///< files that the caller writes when the job is done: they replace none of these
  std::vector<OptionValue> given;    ///< of those declared here; not defaults in a configuration
  bool is_kept = false;              ///< who calls keeps the mesh, and may write it later with the same options

  /// What reports give stable time steps for.
  double wave_speed_m_per_s = kWaveSpeedMPerS;

  /// Declares all but `input` and `input_options`, with the fields of this object as targets.
  void declare_options(OptionSet& options);
};

/// Declares --report, for whoever writes reports.
void declare_reports(OptionSet& options, std::vector<std::string>& reports);

/// Declares --wave-speed, for whoever measures meshes.
void declare_wave_speed(OptionSet& options, double& wave_speed_m_per_s);

/// Declares --space, for whoever writes meshes.
void declare_space(OptionSet& options, Space& space);

/// Gives each value to `job_options` if that declares it (and to job.given), and to the job's input_options if one of
/// `plugin_options` does. Throws Error: usage.unknown_option with the closest name of all, and what OptionSet::set
/// throws.
void distribute_options(const std::vector<OptionValue>& values, OptionSet& job_options,
                        const std::vector<const OptionSet*>& plugin_options, MeshJob& job);

}  // namespace scantet
