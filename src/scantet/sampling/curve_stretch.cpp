// Balls are placed so that each reaches over half a radius of the next: what fills a stretch is one number, the
// integral of 1 over the radius, so the radii are shrunk a little to make it come out even.
#include <algorithm>
#include <cmath>

#include "scantet/sampling/curve_stretch_impl.h"

namespace scantet {
namespace {

constexpr double kStep = 1.5;      // from centre to centre over the radius
constexpr double kOverEnds = 0.5;  // of its radius, how far a ball reaches over the end of what it covers

/// A place on the way along a stretch, and how many radii of balls it is from where the stretch begins.
struct Stop {
  double along_mm;
  double radius_mm;
  double radii;
};

class Track {
 public:
  Track(std::span<const CurveRoom> rooms, const CurveStretch& stretch) {
    pass(stretch.from_mm, radius_at(rooms, stretch.from_mm));
    for (const auto& [along_mm, radius_mm] : rooms) {
      if (along_mm > stretch.from_mm && along_mm < stretch.to_mm) pass(along_mm, radius_mm);
    }
    pass(stretch.to_mm, radius_at(rooms, stretch.to_mm));
  }
  double radii() const { return stops_.back().radii; }
  const std::vector<Stop>& stops() const { return stops_; }

 private:
  static double radius_at(std::span<const CurveRoom> rooms, double along_mm) {
    std::size_t after = 1;
    while (after + 1 < rooms.size() && rooms[after].along_mm < along_mm) ++after;
    const CurveRoom& before = rooms[after - 1];
    const double share = (along_mm - before.along_mm) / (rooms[after].along_mm - before.along_mm);
    return std::lerp(before.radius_mm, rooms[after].radius_mm, std::clamp(share, 0.0, 1.0));
  }
  void pass(double along_mm, double radius_mm) {
    double radii = 0;
    if (!stops_.empty()) {
      const Stop& before = stops_.back();
      radii = before.radii + (along_mm - before.along_mm) / (0.5 * (radius_mm + before.radius_mm));
    }
    stops_.push_back({along_mm, radius_mm, radii});
  }

  std::vector<Stop> stops_;
};

}  // namespace

std::vector<CurveBall> cover_stretch(std::span<const CurveRoom> rooms, const CurveStretch& stretch) {
  const Track track(rooms, stretch);
  const double before = stretch.after_corner ? kOverEnds : 0;
  const double behind = stretch.before_corner ? kOverEnds : kStep;
  const double over_ends = kStep - before - behind;
  const double wanted_count = std::ceil((track.radii() + over_ends) / kStep - 1e-9);
  const std::size_t count = std::max(stretch.fewest, static_cast<std::size_t>(std::max(wanted_count, 0.0)));
  const double fill = track.radii() / (kStep * static_cast<double>(count) - over_ends);
  std::vector<CurveBall> balls;
  auto next = track.stops().begin() + 1;
  for (std::size_t k = 0; k < count; ++k) {
    const double wanted = fill * (kStep * static_cast<double>(k) + before);
    while (next + 1 != track.stops().end() && next->radii < wanted) ++next;
    const Stop& last = *(next - 1);
    const double share = std::clamp((wanted - last.radii) / (next->radii - last.radii), 0.0, 1.0);
    balls.push_back(
        {std::lerp(last.along_mm, next->along_mm, share), fill * std::lerp(last.radius_mm, next->radius_mm, share)});
  }
  return balls;
}

}  // namespace scantet
