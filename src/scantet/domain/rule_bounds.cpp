#include "scantet/domain/rule_bounds.h"

#include "scantet/domain/curve_regions.h"
#include "scantet/domain/domain.h"

namespace scantet {

RuleBounds bounds_on(const Domain& domain, RuleBounds bounds) {
  if (have_junctions(domain.curves())) bounds.small_slack = 1;
  return bounds;
}

}  // namespace scantet
