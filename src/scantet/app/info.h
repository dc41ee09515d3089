// Facts about an input, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/plugin/input_plugin.h"

namespace SCANTET_PROGRAM_API scantet {

/// One block a section, one aligned line an entry. Ends with a line break.
std::string info_text(const std::vector<InfoSection>& sections);

/// {"section": {"key": value}}, in the order given. Ends with a line break.
std::string info_json(const std::vector<InfoSection>& sections);

}  // namespace scantet
