// A point of the curve is asked for anew each time: nothing is kept but the polyline.
#include "scantet/labels/junction_curve.h"

#include <optional>
#include <utility>

#include "scantet/domain/curve_regions.h"
#include "scantet/labels/junction_places.h"

namespace scantet {
namespace {

constexpr double kBeside = 0.25;  // of a voxel's shortest edge: the curve is nearer to its course than that

}  // namespace

JunctionCurve::JunctionCurve(const LabelField& field, PolylineCurve course)
    : CourseCurve(std::move(course)), field_(field), regions_(regions_at(*this)) {}

Point JunctionCurve::at(double along_mm) const {
  const Point guess = course().at(along_mm);
  if (course().corners() && (along_mm <= 0 || along_mm >= length_mm())) return guess;  // a corner
  const Frame& frame = field_.frame();
  JunctionPlaces places(field_);
  const Vec index = frame.to_index(guess);
  const std::optional<Vec> meeting = is_one_curve() ? places.meeting_near(index, regions_) : std::nullopt;
  if (meeting && distance(frame.to_world(*meeting), guess) < kBeside * frame.min_spacing_mm()) {
    return frame.to_world(*meeting);
  }
  const std::optional<Vec> boundary = places.boundary_near(index);
  return boundary ? frame.to_world(*boundary) : guess;
}

Curve::Nearest JunctionCurve::nearest(const Point& p) const {
  Nearest nearest = course().nearest(p);
  const Frame& frame = field_.frame();
  const double beside_mm = kBeside * frame.min_spacing_mm();
  if (nearest.distance_mm > beside_mm || !is_one_curve()) return nearest;
  // From p itself: of a point on the curve the distance is none then, whatever its place beside the polyline.
  const auto place = JunctionPlaces(field_).meeting_near(frame.to_index(p), regions_);
  if (!place) return nearest;
  const Point on_curve = frame.to_world(*place);
  if (distance(on_curve, nearest.point) > 2 * beside_mm) return nearest;
  return {on_curve, nearest.along_mm, distance(on_curve, p)};
}

}  // namespace scantet
