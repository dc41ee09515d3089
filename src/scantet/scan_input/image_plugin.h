// Opens scans: a level set of a grey image read through ITK.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "scantet/field/scan.h"
#include "scantet/plugin/input_plugin.h"

namespace scantet {

/// Scans that are not read from files, by the names that stand for them as inputs: "memory:ct".
using ScansInMemory = std::map<std::string, Scan>;

/// Options: level (required by open(), may be several), inside, outside, as-grey, components, min-component …
/// in_memory: opened by their names, before any file is looked for; null: none.
std::unique_ptr<InputPlugin> make_image_plugin(std::shared_ptr<const ScansInMemory> in_memory = nullptr);

}  // namespace scantet
