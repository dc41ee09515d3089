// The options that say how a scan is made simpler before it is meshed.
#pragma once

#include <string>

#include "scantet/base/options.h"
#include "scantet/reading/simplify.h"

namespace scantet {

struct SimplifyOptions {
  Simplification how;

  /// Declares --median, --smooth and --resample under the heading `group`.
  void declare(OptionSet& options, const std::string& group);

  /// What has been done, as a sentence without a full stop; empty if nothing.
  std::string note() const;
};

}  // namespace scantet
