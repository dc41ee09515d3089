// Refuses options that would change nothing: whoever gave them meant something else.
#pragma once

#include <string>

#include "scantet/app/mesh_job.h"
#include "scantet/base/api.h"
#include "scantet/size_options/size_plan.h"

namespace SCANTET_PROGRAM_API scantet {

/// Whether the option was given with a value, "none" not counted.
bool is_given(const MeshJob& job, const std::string& name);

/// Checks every option in job.given, also one that was given its default value. Throws Error: usage.no_effect, with
/// where the first option that does nothing in this job was given, why it does nothing, and the remedy; usage.place (a
/// set that cannot be read). sizes: of the job.
void refuse_idle_options(const MeshJob& job, const SizePlan& sizes);

/// Sets an option of the plugin that opens or converts `input`. of_plugin: its options.
/// Throws Error: usage.no_effect (an option of other inputs), and what OptionSet::set throws.
void set_input_option(OptionSet& of_plugin, const OptionValue& value, const std::string& input);

}  // namespace scantet
