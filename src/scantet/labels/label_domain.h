// A segmentation as a domain.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scantet/domain/domain.h"
#include "scantet/labels/junctions.h"
#include "scantet/labels/label_field.h"

namespace scantet {

/// What a label domain is told beside its field.
struct LabelDomainParts {
  std::map<Region, std::string> names{};               ///< of the regions; may lack any
  std::vector<std::shared_ptr<const Curve>> curves{};  ///< where three or more regions meet
  std::vector<Corner> corners{};                       ///< where curves end or meet
  std::shared_ptr<const LabelField> of_curves{};       ///< the field that the curves use; null: the domain's
  std::function<Junctions()> trace{};  ///< finds curves and corners when they are asked for first; none: as above
};

/// The regions of a label field. Queries take world mm. residual_at() is the difference of the two largest fields.
/// size_hints() has the parts of regions with few voxels.
///
/// Guarantees: crossings() finds every change of region along a segment, and agrees with region_at() at its ends,
/// whatever rounding does; every crossing has a residual ≤ 1e-9, and its patch is that of its two regions, with
/// components that are not told apart. Nothing is locked but what traces curves; only that and surface_candidates()
/// start threads.
std::unique_ptr<Domain> make_label_domain(std::shared_ptr<const LabelField> field, LabelDomainParts parts = {});

}  // namespace scantet
