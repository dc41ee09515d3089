// The last step to an object of labels.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "scantet/base/progress.h"
#include "scantet/labels/label_field.h"
#include "scantet/labels/label_object.h"

namespace scantet {

/// When junctions are found.
enum class Tracing {
  now,
  when_asked,  ///< where LabelObject::fit can make the object anew; those that cross are not parted
};

/// Finds the junctions of a field, and parts those that cross. field: null where the former step was cancelled. names:
/// of its regions. account: of what made the field. tracing: for who fits the object in any case, when_asked spares the
/// junctions that it has before. Without a domain if cancelled.
LabelObject label_object_of(std::shared_ptr<const LabelField> field, const std::map<Region, std::string>& names,
                            LabelAccount account, Progress& progress, Tracing tracing = Tracing::now);

/// As without tracing, which is then now.
LabelObject make_label_object(const Scan& scan, const LabelSettings& settings, Progress& progress, Tracing tracing);

}  // namespace scantet
