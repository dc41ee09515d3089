// The measures of a mesh by the names that reports call them.
#pragma once

#include <string_view>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/quality/quality.h"

namespace SCANTET_API scantet {

/// A measure as a report has it, in `histograms` and `statistics` of its JSON and in its CSV.
struct NamedDistribution {
  std::string_view name;             ///< "dihedral_deg"; kept from version to version
  const Distribution* distribution;  ///< of the summary, which owns it; never null
};

/// Those that were measured, in the order of reports; valid as long as the summary, and not changed by then. size_ratio
/// and edge_size_ratio are left out where the summary has none.
std::vector<NamedDistribution> named_distributions(const QualitySummary& quality);

}  // namespace scantet
