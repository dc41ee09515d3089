// The places are looked up by the cell of a grid so wide that a place matters only in its own and the 26 cells around.
#include "scantet/domain/sizing_field.h"

#include <algorithm>
#include <cmath>

namespace scantet {

FinerSize::FinerSize(double size_mm, std::vector<FinerPlace> places)
    : size_mm_(size_mm), least_mm_(size_mm), places_(std::move(places)) {
  for (const FinerPlace& place : places_) least_mm_ = std::min(least_mm_, place.size_mm);
  cell_mm_ = std::max(size_mm_ - least_mm_, 1e-3 * size_mm_);
  for (std::uint32_t i = 0; i < places_.size(); ++i) {
    if (places_[i].size_mm >= size_mm_) continue;
    const CellKey center = cell_of(places_[i].point);
    for (int k = 0; k < 27; ++k)
      near_.push_back({{center[0] + k % 3 - 1, center[1] + k / 3 % 3 - 1, center[2] + k / 9 - 1}, i});
  }
  std::sort(near_.begin(), near_.end());
}

FinerSize::CellKey FinerSize::cell_of(const Point& p) const {
  const auto along = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell_mm_)); };
  return {along(p.x), along(p.y), along(p.z)};
}

double FinerSize::size_at(const Point& p) const {
  double size = size_mm_;
  if (near_.empty()) return size;
  const CellKey cell = cell_of(p);
  auto entry = std::lower_bound(near_.begin(), near_.end(), std::pair{cell, std::uint32_t{0}});
  for (; entry != near_.end() && entry->first == cell; ++entry) {
    const FinerPlace& place = places_[entry->second];
    size = std::min(size, place.size_mm + distance(p, place.point));
  }
  return size;
}

}  // namespace scantet
