// The options that say which components and cavities of an image's object are kept.
#pragma once

#include <optional>
#include <string>

#include "scantet/base/options.h"
#include "scantet/image/kept_components.h"

namespace scantet {

struct ComponentOptions {
  std::string components;                   ///< "all", "largest" or a whole number from 1; empty: all
  std::optional<double> min_volume_mm3;     ///< none: any volume
  std::optional<double> fill_cavities_mm3;  ///< none: all cavities stay

  /// Declares --components, --min-component and --fill-cavities under the heading `group`.
  void declare(OptionSet& options, const std::string& group);

  /// What they ask for; nullopt if all components and cavities are kept, whatever they are.
  std::optional<ComponentChoice> choice() const;
};

}  // namespace scantet
