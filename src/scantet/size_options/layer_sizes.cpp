// Normals come from asking the domain around a point: the mean of the directions in which the region lies.
#include "scantet/size_options/layer_sizes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"

namespace scantet {
namespace {

constexpr double kProbe = 0.25;    // of the spacing: how far from a point its surroundings are looked at
constexpr double kSafety = 0.8;    // of the largest size that does
constexpr double kOpposite = 0.7;  // cosine

class Thickness {
 public:
  Thickness(const Domain& domain, const LayerSettings& settings, const SizingField& field)
      : domain_(domain), settings_(settings), field_(field) {}

  /// Adds sizes for each region beside p, a point of the boundary.
  void look_at(const Point& p, std::vector<Cone>& out) {
    std::array<Region, kNeighborhood.size()> around{};
    look_around(p, around);
    std::array<Region, kNeighborhood.size()> distinct = around;
    std::sort(distinct.begin(), distinct.end());
    const auto end = std::unique(distinct.begin(), distinct.end());
    for (auto region = distinct.begin(); region != end; ++region) {
      if (settings_.regions.contains(*region)) look_into(p, *region, inward(around, *region), out);
    }
  }

 private:
  void look_around(const Point& p, std::array<Region, kNeighborhood.size()>& around) const {
    for (std::size_t n = 0; n < around.size(); ++n) {
      const Vec offset = as_vec(kNeighborhood[n]);
      const double size = length(offset);
      around[n] = size > 0 ? domain_.region_at(p + (kProbe * settings_.spacing_mm / size) * offset) : Region{-1};
    }
  }
  /// A unit vector; nothing if the region lies on all sides, or none.
  static std::optional<Vec> inward(const std::array<Region, kNeighborhood.size()>& around, Region region) {
    Vec sum;
    for (std::size_t n = 0; n < around.size(); ++n) {
      const Vec offset = as_vec(kNeighborhood[n]);
      if (around[n] == region) sum = sum + (1 / length(offset)) * offset;
    }
    const double size = length(sum);
    if (!(size > 1e-9)) return std::nullopt;
    return (1 / size) * sum;
  }

  void look_into(const Point& p, Region region, const std::optional<Vec>& direction, std::vector<Cone>& out) {
    if (!direction) return;
    const double share = kSafety / (2.0 * (settings_.layers - 1));
    const double reach = field_.size_at(p) / share;  // parts as thick as that have their layers
    const Point from = p + (0.5 * kProbe * settings_.spacing_mm) * *direction;
    if (domain_.region_at(from) != region) return;
    domain_.crossings({from, p + reach * *direction}, crossings_);
    if (crossings_.empty()) return;
    const Point exit = crossings_.front().point;
    const double thickness = distance(p, exit);
    if (thickness < settings_.thinnest_mm) return;
    std::array<Region, kNeighborhood.size()> around{};
    look_around(exit, around);
    const std::optional<Vec> back = inward(around, region);
    if (!back || dot(*back, *direction) > -kOpposite) return;
    const int steps = std::max(2, static_cast<int>(std::ceil(thickness / settings_.spacing_mm)));
    for (int n = 0; n <= steps; ++n) {
      const Cone cone{lerp(p, exit, static_cast<double>(n) / steps), share * thickness};
      if (cone.height_mm < field_.size_at(cone.apex)) out.push_back(cone);
    }
  }

  const Domain& domain_;
  const LayerSettings& settings_;
  const SizingField& field_;
  Crossings crossings_;
};

}  // namespace

std::vector<Cone> layer_sizes(const Domain& domain, const LayerSettings& settings, const SizingField& field,
                              const Progress& progress) {
  std::vector<Point> points;
  domain.surface_candidates(settings.spacing_mm, [&](const Point& p) { points.push_back(p); });
  constexpr std::size_t kPiece = 1024;
  std::vector<std::vector<Cone>> pieces((points.size() + kPiece - 1) / kPiece);
  parallel_for(points.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    Thickness thickness(domain, settings, field);
    for (std::size_t n = begin; n < end && !progress.cancelled(); ++n) {
      thickness.look_at(points[n], pieces[begin / kPiece]);
    }
  });
  std::vector<Cone> all;
  if (progress.cancelled()) return all;
  for (const std::vector<Cone>& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
  return all;
}

}  // namespace scantet
