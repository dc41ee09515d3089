// Opens scans: a level set of a grey image read through ITK.
#pragma once

#include <memory>

#include "scantet/plugin/input_plugin.h"

namespace scantet {

/// Options: level (required by open(), may be several), inside, outside, as-grey, components, min-component.
std::unique_ptr<InputPlugin> make_image_plugin();

}  // namespace scantet
