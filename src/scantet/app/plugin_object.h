// What plugins read, for the verifier: OpenVDB's grids, surfaces.
#pragma once

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/plugin/plugin_registry.h"
#include "scantet/verification/verify_job.h"

namespace SCANTET_PROGRAM_API scantet {

/// The object of a job as the plugin for it reads it; empty if cancelled. Throws Error: as
/// PluginRegistry::create_for(), InputPlugin::field() and InputPlugin::surface(); usage.grid (there is no choice of
/// grids), usage.repair (there is nothing to repair); input.no_field (it is neither field nor surface).
VerifiedObject plugin_object(const PluginRegistry& plugins, const VerifyJob& job, Progress& progress);

}  // namespace scantet
