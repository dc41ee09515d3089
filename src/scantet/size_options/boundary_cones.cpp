// A number needs a sample as fine as itself; a formula or an image may have any size anywhere, so it is asked on the
// scale of a first look.
#include "scantet/size_options/boundary_cones.h"

#include <algorithm>

#include "scantet/size_options/region_probe.h"

namespace scantet {

AutoSizes auto_sizes(const SizeOptions& options, const OpenedDomain& opened) {
  constexpr double kLeastShare = 1.0 / 200;  // of the longest side of an object that is no image
  constexpr double kPerFeature = 4;          // sample points along the least feature that counts
  const Vec extent = opened.domain->bounds().extent();
  const double usual_least =
      opened.frame ? opened.frame->min_spacing_mm() : kLeastShare * std::max({extent.x, extent.y, extent.z});
  AutoSizes how;
  how.least_mm = options.least_mm.value_or(std::max(usual_least, opened.min_size_mm.value_or(0)));
  how.share = options.feature_share.value_or(kFeatureShare);
  how.features.lipschitz_k = options.lipschitz_k;
  how.features.spacing_mm = std::max(0.5 * how.least_mm, how.least_mm / how.share / kPerFeature);
  return how;
}

BoundaryCones auto_cones(const Domain& domain, const AutoSizes& how, Progress& progress) {
  FeatureSizes features = feature_sizes(domain, how.features, progress);
  for (Cone& cone : features.sizes) cone.height_mm = std::max(how.least_mm, how.share * cone.height_mm);
  return {std::move(features.sizes), features.spacing_mm};
}

double vertices_of(const BoundaryCones& cones, const Domain& domain) {
  const double apart_mm = std::min(cones.spacing_mm, domain.bounds().diagonal());
  // Each of these points stands for a square of boundary, with a vertex for each square of the size there.
  double vertices = 0;
  for (const Cone& cone : cones.sizes) vertices += apart_mm * apart_mm / (cone.height_mm * cone.height_mm);
  return vertices;
}

double rough_vertices(const Domain& domain, const AutoSizes& how, Progress& progress) {
  constexpr double kCoarse = 1.0 / 32;  // of the longest side
  const Vec extent = domain.bounds().extent();
  AutoSizes rough = how;
  rough.features.spacing_mm = std::max(how.features.spacing_mm, kCoarse * std::max({extent.x, extent.y, extent.z}));
  return vertices_of(auto_cones(domain, rough, progress), domain);
}

BoundaryCones asked_cones(const Domain& domain, const SizeRequest& request, const SizeSource& source, double least_mm,
                          Progress& progress) {
  constexpr double kSpacing = 0.5;  // of the size
  const bool is_number = request.kind == SizeRequest::Kind::number;
  BoundaryCones cones;
  cones.spacing_mm = is_number ? kSpacing * request.size_mm : first_look_mm(domain);
  std::vector<SizePlace> places;
  for (const Point& p : boundary_sample(domain, cones.spacing_mm, progress))
    places.push_back({p, 0, region_beside(domain, p, cones.spacing_mm)});
  std::vector<double> asked(places.size());
  source.sizes_at(places, asked);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!(asked[i] > 0)) refuse_size(request.option, request.text, places[i], false, asked[i]);
    const double least = is_number ? 0 : least_mm;
    cones.sizes.push_back({places[i].point, std::min(std::max(asked[i], least), domain.bounds().diagonal())});
  }
  return cones;
}

}  // namespace scantet
