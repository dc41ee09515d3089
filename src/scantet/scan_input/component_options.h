// The options that say which components of an image's object are kept.
#pragma once

#include <optional>
#include <string>

#include "scantet/base/options.h"
#include "scantet/image/kept_components.h"

namespace scantet {

struct ComponentOptions {
  std::string components;                ///< "all", "largest" or a whole number from 1; empty: all
  std::optional<double> min_volume_mm3;  ///< none: any volume

  /// Declares --components and --min-component under the heading `group`.
  void declare(OptionSet& options, const std::string& group);

  /// What they ask for; nullopt if all components are kept, whatever they are.
  std::optional<ComponentChoice> choice() const;
};

}  // namespace scantet
