// Meshing a scan in memory with the options of the command, by their names: for programs whose own settings are names
// and values, as those of a pipeline or a panel are.
#pragma once

#include <vector>

#include "scantet/app/mesh_scan.h"
#include "scantet/base/api.h"
#include "scantet/base/options.h"
#include "scantet/base/progress.h"

namespace SCANTET_API scantet {

/// What mesh_scan_named() can be told: the options of `scantet mesh` for images and for the job, as declared and in
/// that order, but for those of the command line itself (config, plugin, plan, quiet). `assign` and `read` are empty.
std::vector<Option> named_mesh_options();

/// Meshes the scan as `scantet mesh` does a file of it: the files that the options name are read and written, and the
/// mesh has what they put into it (fields, sets, materials, second order). Without a level that is an error, as it is
/// there; a label map is told by its values.
///
/// values: option names without dashes, texts as typed; `place` opens the messages of errors. progress: whatever it is
/// cancelled for (Progress::out_of_budget(), too), there is no mesh then, and nothing is written.
/// Return: as of mesh_scan(); if --max-time or --max-memory came before there was a mesh, no tets, and a finding.
/// Throws Error: usage.unknown_option (with the closest name; an option of the command line itself), usage.value,
/// usage.repeated, usage.level_missing, and whatever else ends the command with a message.
/// Guarantees: the same scan and options give the same mesh and files, bit for bit, as the command; nothing is printed.
MeshOutcome mesh_scan_named(const Scan& scan, const std::vector<OptionValue>& values, Progress& progress);

}  // namespace scantet
