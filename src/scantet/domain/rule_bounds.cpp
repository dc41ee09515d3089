#include "scantet/domain/rule_bounds.h"

#include "scantet/domain/domain.h"

namespace scantet {

RuleBounds bounds_on(const Domain& domain, RuleBounds bounds) {
  if (!domain.curves().empty()) bounds.small_slack = 1;
  return bounds;
}

}  // namespace scantet
