// A facet cut by the planes of a grid. Private to fields/.
//
// The corners of a convex piece ascend along an axis on both ways from the lowest one to the highest. So its parts
// between planes are made in one walk up both ways.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace scantet {

/// A point in index space. Unlike a Vec it is not set to zero at first: buffers of corners are made often.
struct FacetCorner {
  double x, y, z;
};

/// A convex polygon; there is a copy of its last corner behind it.
struct FacetPiece {
  const FacetCorner* corners;
  std::size_t count;
};

template <int kAxis>
double coordinate(const FacetCorner& p) {
  return kAxis == 0 ? p.x : kAxis == 1 ? p.y : p.z;
}

/// Where the edge from a to b meets a plane.
template <int kAxis>
FacetCorner facet_crossing(const FacetCorner& a, const FacetCorner& b, double plane) {
  const double t = (plane - coordinate<kAxis>(a)) / (coordinate<kAxis>(b) - coordinate<kAxis>(a));
  const FacetCorner p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
  return {kAxis == 0 ? plane : p.x, kAxis == 1 ? plane : p.y, kAxis == 2 ? plane : p.z};
}

// A triangle gets at most two more corners along each axis, or four if rounding has bent it.
constexpr std::size_t kFacetCorners = 3 + 3 * 4;

/// A polygon that grows at both ends of its list of corners.
class FacetBand {
 public:
  explicit FacetBand(const FacetCorner& first) { corners_[kMiddle] = first; }

  void put_front(const FacetCorner& p) { corners_[--first_] = p; }
  void put_back(const FacetCorner& p) { corners_[++last_] = p; }
  void begin_with(const FacetCorner& front, const FacetCorner& back) {
    first_ = kMiddle;
    last_ = kMiddle + 1;
    corners_[first_] = front;
    corners_[last_] = back;
  }
  FacetPiece piece() {
    corners_[last_ + 1] = corners_[last_];
    return {&corners_[first_], last_ - first_ + 1};
  }

 private:
  static constexpr std::size_t kMiddle = kFacetCorners;
  std::array<FacetCorner, 2 * kFacetCorners + 2> corners_;
  std::size_t first_ = kMiddle;
  std::size_t last_ = kMiddle;
};

/// Calls take(part, number of the plane below it) for the parts between planes, from below to above. All of it lies
/// above plane 0, and what is above the last plane is one part.
template <int kAxis, class Take>
void slice(const FacetPiece& whole, int last_plane, const Take& take) {
  const FacetCorner* const p = whole.corners;
  double low = coordinate<kAxis>(p[0]);
  double high = low;
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < whole.count; ++i) {
    const double at = coordinate<kAxis>(p[i]);
    high = std::max(high, at);
    if (at < low) {
      low = at;
      lowest = i;
    }
  }
  int below = std::min(static_cast<int>(low), last_plane);
  if (below == last_plane || high <= below + 1) return take(whole, below);
  const auto before = [&](std::size_t i) { return i == 0 ? whole.count - 1 : i - 1; };
  const auto after = [&](std::size_t i) { return i + 1 == whole.count ? 0 : i + 1; };
  FacetBand band(p[lowest]);
  std::size_t left = lowest, right = lowest;  // the last corners below the plane, and the next ones
  std::size_t next_left = before(left), next_right = after(right);
  for (; below < last_plane && below + 1 < high; ++below) {
    const double plane = below + 1;
    for (; coordinate<kAxis>(p[next_left]) <= plane; next_left = before(left)) {
      left = next_left;
      band.put_front(p[left]);
    }
    for (; coordinate<kAxis>(p[next_right]) <= plane; next_right = after(right)) {
      right = next_right;
      band.put_back(p[right]);
    }
    const FacetCorner front = facet_crossing<kAxis>(p[left], p[next_left], plane);
    const FacetCorner back = facet_crossing<kAxis>(p[right], p[next_right], plane);
    band.put_front(front);
    band.put_back(back);
    take(band.piece(), below);
    band.begin_with(front, back);
  }
  for (; next_left != right; next_left = before(next_left)) band.put_front(p[next_left]);
  take(band.piece(), below);
}

/// What is left of a polygon past planes across x, one after the other.
class FacetShrinking {
 public:
  FacetShrinking(const FacetPiece& whole, std::size_t lowest) : last_(whole.count - 1) {
    for (std::size_t i = lowest, to = 0; to <= whole.count; ++to) {
      corners_[to] = whole.corners[i];
      i = i + 1 == whole.count ? 0 : i + 1;
    }
  }

  /// Its first corner lies on the plane. Pre: there are corners past the plane, and planes come in ascending order, all
  /// above the lowest corner.
  FacetPiece past(double plane) {
    while (corners_[first_].x <= plane) ++first_;
    while (corners_[last_].x <= plane) --last_;
    corners_[first_ - 1] = facet_crossing<0>(corners_[first_ - 1], corners_[first_], plane);
    corners_[last_ + 1] = facet_crossing<0>(corners_[last_ + 1], corners_[last_], plane);
    corners_[last_ + 2] = corners_[last_ + 1];
    return {&corners_[first_ - 1], last_ - first_ + 3};
  }

 private:
  std::size_t first_ = 1;
  std::size_t last_;
  std::array<FacetCorner, kFacetCorners + 2> corners_;
};

}  // namespace scantet
