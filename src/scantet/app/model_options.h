// What a mesh carries for a solver: named places.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/options.h"
#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/places/place.h"
#include "scantet/places/scan_values.h"

namespace scantet {

/// As texts.
struct ModelOptions {
  std::vector<std::string> sets;  ///< "foot=z < -40"
};

/// Declares --set.
void declare_model_options(OptionSet& options, ModelOptions& model);

/// What is added to a mesh, read before there is one, so that mistakes are told before hours of work.
struct ModelPlan {
  std::vector<NamedPlace> sets;
  ScanTable scans;
  std::vector<std::string> files;  ///< that were read
};

/// Throws Error: usage.place, input.* of the scans. If progress is cancelled, scans may be missing.
ModelPlan plan_model(const ModelOptions& options, Progress& progress);

/// Adds sets to the mesh. Throws Error: as items_in_place().
void add_model(const ModelPlan& plan, TetMesh& mesh);

}  // namespace scantet
