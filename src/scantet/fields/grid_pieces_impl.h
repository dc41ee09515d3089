// A tet cut by the planes of a grid. Private to fields/.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "scantet/base/geometry.h"

namespace scantet {

/// Corners, in index space.
using IndexTet = std::array<Vec, 4>;

/// A cell: between the planes of these numbers and the next; below the first plane and above the last there is no end.
using GridCell = std::array<int, 3>;

/// A convex polyhedron: what is left of a tet between planes. Faces go round as seen from outside.
class Piece {
 public:
  /// Of a positively oriented tet.
  explicit Piece(const IndexTet& tet);
  Piece() = default;

  /// The part below the plane or on it, and the part above, where there are corners on both sides. False, with nothing
  /// of use in the parts, if rounding has bent a face so that the plane meets it more than once.
  bool cut(int axis, double plane, Piece& below, Piece& above) const;

  /// Least and largest coordinate.
  std::array<double, 2> range(int axis) const;

  /// Calls take(corners, their numbers) for tets that fill it.
  template <class Take>
  void for_each_tet(const Take& take) const {
    for (std::size_t f = 0; f < face_count_; ++f) {
      const Face& face = faces_[f];
      if (std::find(face.begin(), face.begin() + sizes_[f], 0) != face.begin() + sizes_[f]) continue;
      for (std::size_t i = 2; i < sizes_[f]; ++i) take(std::array<std::size_t, 4>{0, face[0], face[i - 1], face[i]});
    }
  }

  std::size_t corner_count() const { return corner_count_; }
  const Vec& corner(std::size_t i) const { return corners_[i]; }
  IndexTet tet_of(const std::array<std::size_t, 4>& numbers) const {
    return {corners_[numbers[0]], corners_[numbers[1]], corners_[numbers[2]], corners_[numbers[3]]};
  }

 private:
  // A tet in a box has at most 16 corners and 10 faces of at most 9; corners on planes can be there twice.
  static constexpr std::size_t kCorners = 28;
  static constexpr std::size_t kFaces = 14;
  static constexpr std::size_t kFaceCorners = 14;
  using Face = std::array<std::uint8_t, kFaceCorners>;
  class Cut;

  std::size_t corner_count_ = 0;
  std::size_t face_count_ = 0;
  std::array<Vec, kCorners> corners_;
  std::array<std::uint8_t, kFaces> sizes_;
  std::array<Face, kFaces> faces_;
};

/// Cuts pieces by all planes where a coordinate is a whole number from `first` up to a last one. Calls
/// take(cell, piece) for each part; they fill the tet, and points of a cut have the plane's coordinate exactly.
template <class Take>
void cut_by_grid(const Piece& whole, int first, const std::array<int, 3>& last, int axis, GridCell& cell,
                 const Take& take) {
  if (axis == 3) return take(cell, whole);
  const auto a = static_cast<std::size_t>(axis);
  const auto [low, high] = whole.range(axis);
  const int from = static_cast<int>(std::clamp(std::floor(low) + 1, double(first), last[a] + 1.0));
  const int to = static_cast<int>(std::clamp(std::ceil(high) - 1, first - 1.0, double(last[a])));
  if (from > to) {
    cell[a] = static_cast<int>(std::clamp(std::floor((low + high) / 2), first - 1.0, double(last[a])));
    return cut_by_grid(whole, first, last, axis + 1, cell, take);
  }
  Piece parts[3];  // the one below, and what is above, before and after
  const Piece* rest = &whole;
  for (int plane = from; plane <= to; ++plane) {
    Piece& above = parts[1 + (plane - from) % 2];
    if (!rest->cut(axis, plane, parts[0], above)) {
      rest->for_each_tet([&](const std::array<std::size_t, 4>& corners) {
        cut_by_grid(Piece(rest->tet_of(corners)), first, last, axis, cell, take);
      });
      return;
    }
    cell[a] = plane - 1;
    cut_by_grid(parts[0], first, last, axis + 1, cell, take);
    rest = &above;
  }
  cell[a] = to;
  cut_by_grid(*rest, first, last, axis + 1, cell, take);
}

}  // namespace scantet
