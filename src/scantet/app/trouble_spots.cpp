#include "scantet/app/trouble_spots.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "scantet/base/point_grid_impl.h"
#include "scantet/base/union_find.h"

namespace scantet {
namespace {

constexpr double kReach = 2;    // sizes, from one fault of a spot to the next
constexpr double kFiner = 0.5;  // of the size at a fault, or of its elements' if these are smaller
// Halving ends after two tries in a row with more than twice as many faults as the best one left, or after one with
// over twenty and more than four times as many.
constexpr int kTriesInVain = 2;
constexpr std::size_t kMore = 2;
constexpr std::size_t kMany = 20;
constexpr std::size_t kFarMore = 4;
constexpr std::array kOtherSizes{0.7, 0.35};  // of the size asked for
constexpr double kAlike = 1.25;  // times its size: what others give at a place, so that it makes no difference
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Many faults of a spot are close together. Looking sizes up takes most of improvement where there are many places.
void add_unless_alike(const FinerPlace& place, std::vector<FinerPlace>& places) {
  const auto covers = [&](const FinerPlace& other) {
    return other.size_mm + distance(other.point, place.point) < kAlike * place.size_mm;
  };
  if (std::none_of(places.begin(), places.end(), covers)) places.push_back(place);
}

}  // namespace

std::size_t TroubleSpots::judge(const MeshFaults& faults) {
  least_own_ = faults.least_own;
  for (Spot& spot : spots_) spot.now = {std::move(spot.now.places), {}, {}};
  std::vector<FinerPlace> all;
  for (const std::vector<Point>* const places : {&faults.handles, &faults.losses}) {
    for (const Point& p : *places) all.push_back({p, std::numeric_limits<double>::infinity()});
  }
  const std::size_t first_element = all.size();
  all.insert(all.end(), faults.elements.begin(), faults.elements.end());
  std::vector<Point> points;
  points.reserve(all.size());
  for (const FinerPlace& fault : all) points.push_back(fault.point);
  const std::vector<std::uint32_t> spots = spots_of(points);
  for (std::size_t f = 0; f < all.size(); ++f) {
    Try& now = spots_[spots[f]].now;
    now.faults.push_back(all[f]);
    ++(f < first_element ? now.count.losses : now.count.elements);
  }
  std::vector<std::uint32_t> troubled(spots.begin() + static_cast<std::ptrdiff_t>(faults.handles.size()), spots.end());
  std::sort(troubled.begin(), troubled.end());
  troubled.erase(std::unique(troubled.begin(), troubled.end()), troubled.end());
  for (Spot& spot : spots_) {
    spot.is_better = !spot.first || spot.now.count < spot.best.count;
    if (!spot.first) spot.first = spot.now;
    if (spot.is_better) spot.best = spot.now;
  }
  return troubled.size();
}

TroubleSpots::Outlook TroubleSpots::outlook() const {
  Outlook outlook;
  for (const Spot& spot : spots_) {
    outlook.spots += spot.best.faults.empty() ? 0 : 1;
    outlook.faults += spot.best.faults.size();
  }
  return outlook;
}

bool TroubleSpots::choose(bool is_last) {
  const FinerSize size(size_, places());
  bool is_other = false;
  for (Spot& spot : spots_) is_other = choose(spot, size, is_last) || is_other;
  return is_other;
}

std::vector<FinerPlace> TroubleSpots::places() const {
  std::vector<FinerPlace> places;
  for (const Spot& spot : spots_) places.insert(places.end(), spot.now.places.begin(), spot.now.places.end());
  return places;
}

std::vector<FinerPlace> TroubleSpots::places_without_faults() const {
  std::vector<FinerPlace> places;
  for (const Spot& spot : spots_) {
    if (spot.now.faults.empty()) places.insert(places.end(), spot.now.places.begin(), spot.now.places.end());
  }
  return places;
}

/// The nearest spot that has had a fault near it, or a new one with those that have none.
std::vector<std::uint32_t> TroubleSpots::spots_of(const std::vector<Point>& faults) {
  const double row_mm = kReach * size_->usual_size();
  const PointGrid known(seen_, row_mm);
  const PointGrid grid(faults, row_mm);
  std::vector<std::uint32_t> spots(faults.size(), kNone);
  UnionFind sets(faults.size());
  for (std::uint32_t f = 0; f < faults.size(); ++f) {
    const double reach_mm = kReach * size_->size_at(faults[f]);
    std::pair nearest{reach_mm * reach_mm, kNone};
    known.any_near(faults[f], reach_mm, [&](std::uint32_t other, const Point&, double squared) {
      nearest = std::min(nearest, {squared, spot_of_[other]});
      return false;
    });
    spots[f] = nearest.second;
    grid.any_near(faults[f], reach_mm, [&](std::uint32_t other, const Point&, double) {
      sets.unite(f, other);
      return false;
    });
  }
  // Those of a set that are near no spot are a new one.
  std::vector<std::uint32_t> new_spot(faults.size(), kNone);
  for (std::uint32_t f = 0; f < faults.size(); ++f) {
    if (spots[f] == kNone) {
      std::uint32_t& spot = new_spot[sets.find(f)];
      if (spot == kNone) {
        spot = static_cast<std::uint32_t>(spots_.size());
        spots_.emplace_back();
      }
      spots[f] = spot;
    }
    seen_.push_back(faults[f]);
    spot_of_.push_back(spots[f]);
  }
  return spots;
}

/// Where elements are smaller than the size already, half of the size would leave them as they are.
void TroubleSpots::halve(const SizingField& size, Try& now) const {
  for (const auto& [p, own_mm] : now.faults) {
    const double size_mm = size.size_at(p);
    add_unless_alike({p, kFiner * std::clamp(own_mm, least_own_ * size_mm, size_mm)}, now.places);
  }
}

bool TroubleSpots::choose(Spot& spot, const SizingField& size, bool is_last) const {
  Try& now = spot.now;
  const std::size_t least = spot.best.faults.size();
  const bool is_far_worse = now.faults.size() > kMany && now.faults.size() > kFarMore * least;
  spot.in_vain = now.faults.size() <= kMore * least ? 0 : spot.in_vain + 1;
  if (now.faults.empty()) return false;
  if (!is_last && spot.retries == 0 && !is_far_worse && spot.in_vain < kTriesInVain) {
    halve(size, now);
    return true;
  }
  if (!is_last && spot.retries < kOtherSizes.size()) {
    const double share = kOtherSizes[spot.retries++];
    now.places.clear();
    for (const FinerPlace& fault : spot.first->faults) {
      add_unless_alike({fault.point, share * size_->size_at(fault.point)}, now.places);
    }
    return true;
  }
  const bool is_settled = spot.retries > kOtherSizes.size();
  if (!is_last && is_settled && now.faults.size() > least) {  // as other spots have changed
    spot = {now, now, now};
    halve(size, spot.now);
    return true;
  }
  const bool is_other = !spot.is_better && !is_settled;
  spot.retries = kOtherSizes.size() + 1;
  if (is_other) now = spot.best;
  return is_other;
}

}  // namespace scantet
