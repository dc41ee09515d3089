// Places along a curve are looked at one after the other; where it changes sides bisection finds the plane.
#include "scantet/cuts/clipped_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "scantet/cuts/plane_axes.h"
#include "scantet/domain/curve_regions.h"
#include "scantet/domain/nearest_crossing.h"

namespace scantet {
namespace {

/// A stretch of another curve. Beyond the length of a closed one its places begin anew.
class ClippedCurve final : public Curve {
 public:
  ClippedCurve(std::shared_ptr<const Curve> whole, double from_mm, double to_mm, const std::array<Point, 2>& ends,
               const std::array<std::size_t, 2>& corners)
      : whole_(std::move(whole)), from_mm_(from_mm), length_mm_(to_mm - from_mm), ends_(ends), corners_(corners) {}

  double length_mm() const override { return length_mm_; }
  Point at(double along_mm) const override {
    if (along_mm <= 0) return ends_[0];
    if (along_mm >= length_mm_) return ends_[1];
    const double whole_mm = from_mm_ + along_mm;
    return whole_->at(whole_mm > whole_->length_mm() && !whole_->corners() ? whole_mm - whole_->length_mm() : whole_mm);
  }
  Nearest nearest(const Point& p) const override {
    // A curve's places may be a little beside those that it finds nearest to its points: ends go first.
    constexpr double kAtEnd = 1e-9;  // of the length
    const double to_start = distance(p, ends_[0]);
    const double to_end = distance(p, ends_[1]);
    const Nearest end = to_start <= to_end ? Nearest{ends_[0], 0, to_start} : Nearest{ends_[1], length_mm_, to_end};
    if (end.distance_mm <= kAtEnd * length_mm_) return end;
    Nearest nearest = whole_->nearest(p);
    nearest.along_mm -= from_mm_;
    if (nearest.along_mm < 0 && !whole_->corners()) nearest.along_mm += whole_->length_mm();
    return nearest.along_mm >= 0 && nearest.along_mm <= length_mm_ ? nearest : end;
  }
  std::vector<Region> regions() const override { return whole_->regions(); }
  std::optional<std::array<std::size_t, 2>> corners() const override { return corners_; }
  std::string name() const override { return whole_->name(); }

 private:
  std::shared_ptr<const Curve> whole_;
  double from_mm_;
  double length_mm_;
  std::array<Point, 2> ends_;
  std::array<std::size_t, 2> corners_;
};

/// A curve with other numbers for its corners.
class RenumberedCurve final : public Curve {
 public:
  RenumberedCurve(std::shared_ptr<const Curve> curve, const std::array<std::size_t, 2>& corners)
      : curve_(std::move(curve)), corners_(corners) {}
  double length_mm() const override { return curve_->length_mm(); }
  Point at(double along_mm) const override { return curve_->at(along_mm); }
  Nearest nearest(const Point& p) const override { return curve_->nearest(p); }
  std::vector<Region> regions() const override { return curve_->regions(); }
  std::optional<std::array<std::size_t, 2>> corners() const override { return corners_; }
  std::string name() const override { return curve_->name(); }

 private:
  std::shared_ptr<const Curve> curve_;
  std::array<std::size_t, 2> corners_;
};

class CurveClipper {
 public:
  CurveClipper(const CutSpace& space, CutCurves& found) : space_(space), found_(found) {
    const std::vector<Corner> corners = space.inner.corners();
    for (std::size_t c = 0; c < corners.size(); ++c) {
      if (!space.keeps(corners[c].point)) continue;
      number_[c] = found_.corners.size();
      found_.corners.push_back(corners[c]);
    }
  }

  void clip(const std::shared_ptr<const Curve>& curve) {
    const double length_mm = curve->length_mm();
    const auto steps = static_cast<std::size_t>(std::ceil(length_mm / (0.5 * space_.step_mm))) + 4;
    std::vector<double> changes;  // places where the curve changes sides
    double before_mm = 0;
    const bool starts_kept = is_kept(*curve, 0);
    bool was_kept = starts_kept;
    for (std::size_t n = 1; n <= steps; ++n) {
      const double along_mm = length_mm * static_cast<double>(n) / static_cast<double>(steps);
      const bool kept = is_kept(*curve, along_mm);
      if (kept != was_kept) changes.push_back(change_between(*curve, before_mm, along_mm, was_kept));
      was_kept = kept;
      before_mm = along_mm;
    }
    if (changes.empty()) {
      if (starts_kept) keep_whole(curve);
      return;
    }
    keep_stretches(curve, changes, starts_kept);
  }

  std::vector<CurveHit> take_hits() { return std::move(hits_); }

 private:
  struct End {
    Point point;
    std::size_t corner;
  };

  bool is_kept(const Curve& curve, double along_mm) const { return space_.keeps(curve.at(along_mm)); }

  double change_between(const Curve& curve, double low_mm, double high_mm, bool low_is_kept) const {
    for (int step = 0; step < 60; ++step) {
      const double middle_mm = 0.5 * (low_mm + high_mm);
      (is_kept(curve, middle_mm) == low_is_kept ? low_mm : high_mm) = middle_mm;
    }
    return low_is_kept ? low_mm : high_mm;
  }

  void keep_whole(const std::shared_ptr<const Curve>& curve) {
    const auto ends = curve->corners();
    if (!ends) return found_.curves.push_back(curve);
    const auto first = number_.find((*ends)[0]);
    const auto last = number_.find((*ends)[1]);
    if (first == number_.end() || last == number_.end()) return;
    found_.curves.push_back(std::make_shared<RenumberedCurve>(curve, std::array{first->second, last->second}));
  }

  void keep_stretches(const std::shared_ptr<const Curve>& curve, std::vector<double> changes, bool starts_kept) {
    const auto ends = curve->corners();
    const double length_mm = curve->length_mm();
    std::vector<End> at;
    at.reserve(changes.size() + 1);
    for (const double along_mm : changes) at.push_back(hit(*curve, along_mm));
    if (!ends && starts_kept) {  // the last stretch goes on through the start
      changes.push_back(changes.front() + length_mm);
      at.push_back(at.front());
    }
    if (ends && starts_kept && number_.count((*ends)[0]) > 0) {
      add(curve, 0, changes[0], {curve->at(0), number_[(*ends)[0]]}, at[0]);
    }
    for (std::size_t n = starts_kept ? 1 : 0; n < changes.size(); n += 2) {
      if (n + 1 < changes.size()) {
        add(curve, changes[n], changes[n + 1], at[n], at[n + 1]);
      } else if (ends && number_.count((*ends)[1]) > 0) {
        add(curve, changes[n], length_mm, at[n], {curve->at(length_mm), number_[(*ends)[1]]});
      }
    }
  }

  /// The corner where the curve meets a plane.
  End hit(const Curve& curve, double along_mm) {
    const Point p = curve.at(along_mm);
    std::size_t plane = 0;
    for (std::size_t k = 1; k < space_.planes.size(); ++k) {
      if (space_.planes[k].beyond_mm(p) > space_.planes[plane].beyond_mm(p)) plane = k;
    }
    std::vector<Region> regions = regions_at(curve);
    unite_regions(regions, std::array{kOutside});
    const Point on_plane = beside_object(space_.planes[plane], space_.planes[plane].nearest(p));
    found_.corners.push_back({on_plane, regions, {}});
    hits_.push_back({plane, found_.corners.size() - 1});
    return {on_plane, found_.corners.size() - 1};
  }

  /// A curve found cell by cell may jump a little from one to the next, and a plane be between the two: p, in the
  /// plane, is beside the object then. Return: p, or where the object begins nearest to it in the plane.
  Point beside_object(const CutPlane& plane, const Point& p) const {
    if (space_.inner.region_at(p) != kOutside) return p;
    constexpr double kReach = 0.5;  // of a step
    constexpr std::array<std::array<double, 2>, 8> kWays{
        {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    const PlaneAxes axes(plane, p);
    Crossings crossings;
    Crossings found;
    for (const auto& [u, v] : kWays) {
      const double reach_mm = kReach * space_.step_mm;
      space_.inner.crossings({p, axes.at(reach_mm * u, reach_mm * v)}, crossings);
      if (!crossings.empty()) found.push_back(crossings.front());
    }
    const Crossing* const nearest = nearest_crossing(found, p);
    return nearest != nullptr ? plane.nearest(nearest->point) : p;
  }

  void add(const std::shared_ptr<const Curve>& curve, double from_mm, double to_mm, const End& from, const End& to) {
    constexpr double kNothing = 1e-9;  // of the step
    if (!(to_mm - from_mm > kNothing * space_.step_mm)) return;
    found_.curves.push_back(std::make_shared<ClippedCurve>(curve, from_mm, to_mm, std::array{from.point, to.point},
                                                           std::array{from.corner, to.corner}));
  }

  const CutSpace& space_;
  CutCurves& found_;
  std::map<std::size_t, std::size_t> number_;  // of the domain's corners that stay, among those found
  std::vector<CurveHit> hits_;
};

}  // namespace

std::vector<CurveHit> clip_curves(const CutSpace& space, CutCurves& found) {
  CurveClipper clipper(space, found);
  for (const auto& curve : space.inner.curves()) clipper.clip(curve);
  return clipper.take_hits();
}

}  // namespace scantet
