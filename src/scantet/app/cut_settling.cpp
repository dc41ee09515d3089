// Where nodes around a rim keep their values it is found again where it was, and so are its vertices.
#include "scantet/app/cut_settling.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "scantet/cuts/cut_domain.h"
#include "scantet/cuts/cut_grid.h"

namespace scantet {
namespace {

/// Places along all curves, no farther apart than a step.
std::vector<Point> places_along_curves(const Domain& domain, double step_mm) {
  std::vector<Point> places;
  for (const std::shared_ptr<const Curve>& curve : domain.curves()) {
    const double length_mm = curve->length_mm();
    const auto steps = static_cast<std::size_t>(std::ceil(length_mm / step_mm));
    for (std::size_t n = 0; n <= steps; ++n) {
      places.push_back(curve->at(length_mm * static_cast<double>(n) / static_cast<double>(steps)));
    }
  }
  return places;
}

/// The regions that no plane comes near, found when they are asked for first: nodes keep their labels.
class WholeRegions {
 public:
  explicit WholeRegions(std::function<RegionGrid()> grid) : grid_(std::move(grid)) {}

  bool has(Region region) {
    if (!regions_) {
      regions_.emplace();
      for (const GridRegion& left : grid_().regions) {
        if (std::isfinite(left.volume_mm3)) regions_->insert(left.region);
      }
    }
    return regions_->count(region) > 0;
  }

 private:
  std::function<RegionGrid()> grid_;  // of what is left
  std::optional<std::set<Region>> regions_;
};

/// What settling_of_cut() makes, for each domain anew.
class CutSettling {
 public:
  CutSettling(Settling whole, const Domain& cut, std::shared_ptr<WholeRegions> regions, const Cutting& cutting)
      : whole_(std::move(whole)),
        curves_(places_along_curves(cut, cutting.step_mm)),
        regions_(std::move(regions)),
        cutting_(cutting) {}

  FittedDomain operator()(const std::map<Region, double>& volumes_mm3, std::span<const Point> held,
                          Progress& progress) const {
    std::map<Region, double> whole_mm3 = volumes_mm3;
    std::erase_if(whole_mm3, [&](const auto& volume) { return !regions_->has(volume.first); });
    std::vector<Point> stay = curves_;
    stay.insert(stay.end(), held.begin(), held.end());
    FittedDomain settled = whole_(whole_mm3, stay, progress);
    if (!settled.domain) return settled;
    settled.domain = make_cut_domain(std::move(settled.domain), cutting_.planes, cutting_.step_mm, cutting_.spacing_mm);
    settled.grid = [grid = std::move(settled.grid), planes = cutting_.planes] { return cut_grid(grid(), planes); };
    if (settled.settle) settled.settle = CutSettling(std::move(settled.settle), *settled.domain, regions_, cutting_);
    return settled;
  }

 private:
  Settling whole_;
  std::vector<Point> curves_;  // places along them
  std::shared_ptr<WholeRegions> regions_;
  Cutting cutting_;
};

}  // namespace

Settling settling_of_cut(Settling whole, const Domain& cut, std::function<RegionGrid()> grid, const Cutting& cutting) {
  return CutSettling(std::move(whole), cut, std::make_shared<WholeRegions>(std::move(grid)), cutting);
}

}  // namespace scantet
