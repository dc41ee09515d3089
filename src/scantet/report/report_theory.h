// What a report says of the paper's proofs.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// Which bounds the proofs of the paper would need that this run does not have.
struct ReportTheory {
  std::string theorem;              ///< "Theorem 3"
  std::vector<std::string> needed;  ///< "--alpha under 0.2 (here 1)"
  std::string meaning;              ///< a sentence or two for people
};

}  // namespace scantet
