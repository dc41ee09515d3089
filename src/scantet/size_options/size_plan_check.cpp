#include "scantet/size_options/size_plan_check.h"

#include <algorithm>

#include "scantet/base/error.h"
#include "scantet/size_options/region_probe.h"

namespace scantet {
namespace {

void check_regions(const SizePlan& plan, const Domain& domain) {
  const std::set<Region> known = regions_of(domain);
  for (const auto& [region, size] : plan.regions) {
    if (known.empty() || known.contains(region)) continue;
    throw Error(Fault::usage, "usage.region_size", "--region-size: the object has no region " + std::to_string(region),
                *known.rbegin() == 1 ? "its only region is 1"
                                     : "its regions are numbered from 1 to " + std::to_string(*known.rbegin()));
  }
}

/// A number on the boundary counts where it is less than inside.
void refuse_idle_boundary_size(const SizePlan& plan, double default_size_mm) {
  if (!plan.has_one_size_inside() || plan.boundary.kind != SizeRequest::Kind::number) return;
  double largest_mm = plan.one_size_mm(default_size_mm);
  for (const auto& [region, size_mm] : plan.regions) largest_mm = std::max(largest_mm, size_mm);
  if (plan.boundary.size_mm < largest_mm) return;
  throw Error(Fault::usage, "usage.no_effect",
              "--boundary-size: it does nothing here: " + plan.boundary.text +
                  " mm is not less than the size inside, " + number_text(largest_mm) + " mm",
              "leave it out, or choose less than that");
}

}  // namespace

void check_plan(const SizePlan& plan, const OpenedDomain& opened) {
  if (!plan.regions.empty()) check_regions(plan, *opened.domain);
  refuse_idle_boundary_size(plan, opened.default_size_mm);
}

}  // namespace scantet
