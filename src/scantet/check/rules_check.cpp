// A triangulation and a refinement of their own: nothing of the run that made the sample is used.
#include "scantet/check/rules_check.h"

#include "scantet/base/parallel.h"
#include "scantet/refine/refinement_impl.h"
#include "scantet/surface/restricted_triangulation_impl.h"

namespace scantet {

UnmetRules check_rules(const std::vector<Point>& sample, const std::vector<std::uint8_t>& dimensions,
                       const Domain& domain, const SizingField& size, const MesherOptions& options) {
  std::vector<engine::SamplePoint> points;
  points.reserve(sample.size());
  for (std::size_t i = 0; i < sample.size(); ++i) points.push_back({sample[i], dimensions[i]});
  UnmetRules unmet;
  with_threads(options.threads, [&] {
    engine::RestrictedTriangulation triangulation(domain);
    Progress silent;
    if (!triangulation.build(std::move(points), silent)) return;
    MesherOptions bounded = options;
    bounded.bounds = bounds_on(domain, options.bounds);
    unmet = engine::Refinement(triangulation, size, bounded, silent).unmet();
  });
  return unmet;
}

}  // namespace scantet
