// From the size options of a job to its sizing field.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/plugin/input_plugin.h"
#include "scantet/size_options/layer_sizes.h"
#include "scantet/size_options/size_options.h"
#include "scantet/size_options/size_plan.h"

namespace SCANTET_PROGRAM_API scantet {

struct ChosenSize {
  std::shared_ptr<const SizingField> field;  ///< null if cancelled
  std::string text;                          ///< for the report: the number, or what was typed
  double expected_vertices = 0;              ///< on the boundary, roughly, of sizes that are asked for there
  std::optional<double> uniform_mm;          ///< if they do not
  std::vector<std::string> notes;
  std::optional<LayerSettings> layers{};  ///< what is asked of thin parts
  std::vector<std::string> files;         ///< every file that sizes were read from, for the report's checksum
};

/// Makes the field. Throws Error: as read_scan for an image; input.size_image (it is elsewhere than the object);
/// usage.size (a size is not positive: says where); usage.region_size, usage.layers (no such region); usage.no_effect
/// (a number on the boundary that is not less than inside).
ChosenSize choose_size(const SizeOptions& options, const SizePlan& plan, const OpenedDomain& opened,
                       Progress& progress);

}  // namespace scantet
