// The last step to an object of labels.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "scantet/base/progress.h"
#include "scantet/labels/label_field.h"
#include "scantet/labels/label_object.h"

namespace scantet {

/// Finds the junctions of a field, and parts those that cross. field: null where the former step was cancelled. names:
/// of its regions. account: of what made the field. phase_name: of the account's phase. Without a domain if cancelled.
LabelObject label_object_of(std::shared_ptr<const LabelField> field, const std::map<Region, std::string>& names,
                            LabelAccount account, Progress& progress, const char* phase_name = "junctions");

}  // namespace scantet
