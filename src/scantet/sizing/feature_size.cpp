// The sample is an evened-out Poisson-disk sample, as the mesher starts from. It is made twice as dense until the least
// feature is wide beside its spacing; but no denser than asked for, or than 200,000 points allow, estimated from a
// coarser sample.
#include "scantet/sizing/feature_size.h"

#include <cmath>
#include <limits>

#include "scantet/base/parallel.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/sampling/initial_sample.h"
#include "scantet/sampling/poles.h"
#include "scantet/sizing/lipschitz_radius_impl.h"

namespace scantet {
namespace {

constexpr double kMostPoints = 2e5;
constexpr double kLeastSpread = 0.785398163397448;  // 45°: poles of less are not on the medial axis that counts
constexpr double kFirstLook = 1.0 / 128;            // of the longest side of the bounds
constexpr double kResolved = 4;                     // spacings: the least feature size that they measure well
constexpr std::size_t kGrain = 1024;

std::vector<Point> sample_of(const Domain& domain, double spacing_mm, Progress& progress) {
  return initial_sample(domain, UniformSize(spacing_mm), {}, progress);
}

/// The spacing asked for, or more if that would take too many points.
double affordable_spacing(const Domain& domain, double spacing_mm, Progress& progress) {
  const Vec extent = domain.bounds().extent();
  const double coarse_mm = kFirstLook * std::max({extent.x, extent.y, extent.z});
  if (coarse_mm <= spacing_mm) return spacing_mm;
  const auto points = static_cast<double>(sample_of(domain, coarse_mm, progress).size());
  return std::max(spacing_mm, coarse_mm * std::sqrt(points / kMostPoints));
}

std::vector<double> distances_to_poles(const Domain& domain, const std::vector<Point>& sample, Progress& progress) {
  std::vector<Cone> axis;
  for (const Pole& pole : poles_of(sample, domain.bounds(), progress)) {
    if (pole.spread_rad >= kLeastSpread && is_finite(pole.center)) axis.push_back({pole.center, 0});
  }
  const ConeTree tree(std::move(axis));
  std::vector<double> sizes(sample.size());
  parallel_for(sample.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      sizes[i] = tree.lowest_at(sample[i], std::numeric_limits<double>::infinity()).value_mm;
    }
  });
  return sizes;
}

FeatureSizes sizes_at_spacing(const Domain& domain, const FeatureOptions& options, double spacing_mm,
                              Progress& progress) {
  progress.report({"sizes", "feature size", 0, std::nullopt, 0});
  if (progress.cancelled()) return {};
  const std::vector<Point> sample = sample_of(domain, spacing_mm, progress);
  if (progress.cancelled()) return {};
  std::vector<double> sizes;
  const bool done = run_interruptible(progress, [&] {
    sizes = options.lipschitz_k ? lipschitz_radii(domain, sample, spacing_mm, *options.lipschitz_k)
                                : distances_to_poles(domain, sample, progress);
  });
  if (!done) return {};
  const double longest_mm = domain.bounds().diagonal();
  FeatureSizes result;
  result.spacing_mm = spacing_mm;
  for (std::size_t i = 0; i < sample.size(); ++i) result.sizes.push_back({sample[i], std::min(sizes[i], longest_mm)});
  return result;
}

}  // namespace

std::vector<Point> boundary_sample(const Domain& domain, double& spacing_mm, Progress& progress) {
  spacing_mm = affordable_spacing(domain, spacing_mm, progress);
  return progress.cancelled() ? std::vector<Point>() : sample_of(domain, spacing_mm, progress);
}

FeatureSizes feature_sizes(const Domain& domain, const FeatureOptions& options, Progress& progress) {
  const double finest_mm = affordable_spacing(domain, options.spacing_mm, progress);
  if (progress.cancelled()) return {};
  const Vec extent = domain.bounds().extent();
  double spacing_mm = std::max(finest_mm, kFirstLook * std::max({extent.x, extent.y, extent.z}));
  while (true) {
    FeatureSizes result = sizes_at_spacing(domain, options, spacing_mm, progress);
    if (progress.cancelled()) return {};
    const auto smaller = [](const Cone& a, const Cone& b) { return a.height_mm < b.height_mm; };
    const auto least = std::min_element(result.sizes.begin(), result.sizes.end(), smaller);
    if (spacing_mm <= finest_mm || least->height_mm >= kResolved * spacing_mm) return result;
    spacing_mm = std::max(finest_mm, 0.5 * spacing_mm);
  }
}

}  // namespace scantet
