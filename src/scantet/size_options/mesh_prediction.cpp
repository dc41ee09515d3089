// The lattice inside has so many vertices for each cube of the size, and the first sample of the boundary so many for
// each cube that the boundary passes. What comes on top where the boundary is rough hardly depends on the size: there
// it is sampled as finely as the voxels are. docs/sizing.md says how far off the predictions are.
#include "scantet/size_options/mesh_prediction.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scantet/domain/noise.h"
#include "scantet/size_options/boundary_look.h"
#include "scantet/size_options/prediction_coefficients.h"

namespace scantet {
namespace {

/// Another field times a factor.
class ScaledSize final : public SizingField {
 public:
  ScaledSize(const SizingField& size, double factor) : size_(size), factor_(factor) {}
  double size_at(const Point& p) const override { return factor_ * size_.size_at(p); }
  double min_size() const override { return factor_ * size_.min_size(); }

 private:
  const SizingField& size_;
  double factor_;
};

double known_volume_mm3(const Domain& domain) {
  double volume_mm3 = 0;
  for (const Component& component : domain.components()) {
    if (component.region != kOutside) volume_mm3 += component.volume_mm3;
  }
  return volume_mm3;
}

double cube(double x) {
  return x * x * x;
}

constexpr int kCells = 40;  // of the bounding box, along each axis

/// The mean of 1/σ³ over points of the boundary, a cell apart; where none is found, its largest value.
double mean_on_boundary(const Domain& domain, const SizingField& size) {
  const Vec extent = domain.bounds().extent();
  double sum = 0;
  double count = 0;
  domain.surface_candidates(std::max({extent.x, extent.y, extent.z}) / kCells, [&](const Point& p) {
    sum += 1 / cube(size.size_at(p));
    ++count;
  });
  return count > 0 ? sum / count : 1 / cube(size.min_size());
}

/// The integral of 1/σ³, by 40 x 40 x 40 points of the bounding box; by the volume, if that is known, where all of them
/// miss an object that is too thin.
double integral_inside(const Domain& domain, const SizingField& size) {
  const Box bounds = domain.bounds();
  const Vec cell = (1.0 / kCells) * bounds.extent();
  std::vector<Point> points;
  constexpr int kCount = kCells * kCells * kCells;
  points.reserve(std::size_t{kCount});
  for (int n = 0; n < kCount; ++n) {
    const Vec place{n % kCells + 0.5, n / kCells % kCells + 0.5, n / kCells / kCells + 0.5};
    points.push_back(bounds.min + Vec{place.x * cell.x, place.y * cell.y, place.z * cell.z});
  }
  std::vector<Region> regions(points.size());
  domain.regions_at(points, regions);
  double sum = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (regions[n] != kOutside) sum += cell.x * cell.y * cell.z / cube(size.size_at(points[n]));
  }
  if (sum > 0) return sum;
  const double volume_mm3 = known_volume_mm3(domain);
  return volume_mm3 > 0 ? volume_mm3 * mean_on_boundary(domain, size) : 0;
}

bool is_uniform(const SizingField& size) {
  return dynamic_cast<const UniformSize*>(&size) != nullptr;
}

/// Vertices by where they come from.
struct Shares {
  double inside;
  double boundary;
  double rough;

  double sum() const { return inside + boundary + rough; }
  double cost(const ShareCosts& costs) const {
    return costs.least + inside * costs.inside + boundary * costs.boundary + rough * costs.rough;
  }
};

Shares shares_of(const MeshFeatures& features) {
  return {features.inside * kVertexCosts.inside, features.cubes * kVertexCosts.cubes,
          features.narrow * kVertexCosts.narrow + features.bent * kVertexCosts.bent};
}

}  // namespace

double MeshPrediction::seconds(int threads) const {
  return processor_s * (kSerialShare + (1 - kSerialShare) / std::max(1, threads));
}

MeshPrediction predict(const MeshFeatures& features) {
  const Shares shares = shares_of(features);
  const double lost = features.cubes > 0 ? kTetsLost / (kTetsRoom + features.inside / features.cubes) : 0;
  return {shares.sum(), shares.sum() * (kTetsInside - lost), shares.cost(kByteCosts), shares.cost(kSecondCosts)};
}

MeshFeatures find_inside(const Domain& domain, const SizingField& size) {
  constexpr double kShareOfBox = 0.05;
  if (!is_uniform(size)) return {integral_inside(domain, size), 0, 0, 0};
  const double volume_mm3 = known_volume_mm3(domain);
  const Vec extent = domain.bounds().extent();
  return {(volume_mm3 > 0 ? volume_mm3 : kShareOfBox * extent.x * extent.y * extent.z) / cube(size.min_size()), 0, 0,
          0};
}

std::optional<MeshFeatures> find_features(const Domain& domain, const SizingField& size, double alpha,
                                          std::optional<double> finest_mm, Progress& progress) {
  constexpr double kSampleShare = 0.92;  // of the size: the spacing of the first sample, where nothing is narrow
  constexpr double kHintShare = 0.5;     // of a hint's radius: the spacing there
  MeshFeatures features = find_inside(domain, size);
  if (is_uniform(size) && known_volume_mm3(domain) == 0) features.inside = integral_inside(domain, size);
  const ScaledSize on_boundary(size, alpha);
  const bool is_mended = !is_noise(domain, size);
  if (is_mended) {
    domain.size_hints([&](const SizeHint& hint) {
      const double finer = kSampleShare * on_boundary.size_at(hint.point) / (kHintShare * hint.radius_mm);
      if (finer > 1) features.narrow += std::sqrt(std::log2(finer));
    });
  }
  const auto look = look_at_boundary(domain, on_boundary, finest_mm, progress);
  if (!look) return std::nullopt;
  features.cubes = look->cubes;
  features.bent = is_mended ? look->bent : 0;
  return features;
}

}  // namespace scantet
