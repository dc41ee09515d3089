// Which side a corner is on is decided by its coordinate alone, so the faces on both sides fit together whatever
// rounding did to the points.
#include "scantet/fields/grid_pieces_impl.h"

namespace scantet {

/// One cut in the making.
class Piece::Cut {
 public:
  Cut(const Piece& whole, int axis, double plane, Piece& below, Piece& above)
      : whole_(whole), axis_(axis), plane_(plane), below_(below), above_(above) {
    for (Piece* part : {&below, &above}) part->corner_count_ = part->face_count_ = 0;
    for (std::size_t i = 0; i < whole.corner_count_; ++i) {
      is_below_[i] = whole.corners_[i][axis] <= plane;
      number_[i] = add_corner(is_below_[i] ? below : above, whole.corners_[i]);
    }
  }

  bool make() {
    for (std::size_t f = 0; f < whole_.face_count_; ++f) {
      if (!cut_face(whole_.faces_[f], whole_.sizes_[f])) return false;
    }
    return close();
  }

 private:
  static constexpr std::size_t kCuts = 12;

  /// A point of the cut: on the edge between two corners, with its number in both parts.
  struct CutEdge {
    std::size_t low, high;
    std::uint8_t in_below, in_above;
    std::size_t next;  // along the rim of the part below
  };

  static std::uint8_t add_corner(Piece& part, const Vec& p) {
    part.corners_[part.corner_count_] = p;
    return static_cast<std::uint8_t>(part.corner_count_++);
  }

  /// Its place in edges_; kCuts if there is no room.
  std::size_t point_between(std::size_t u, std::size_t w) {
    const auto [low, high] = std::minmax(u, w);
    for (std::size_t e = 0; e < count_; ++e) {
      if (edges_[e].low == low && edges_[e].high == high) return e;
    }
    if (count_ == kCuts || below_.corner_count_ == kCorners || above_.corner_count_ == kCorners) return kCuts;
    const Vec& a = whole_.corners_[low];
    const Vec& b = whole_.corners_[high];
    Vec p = lerp(a, b, (plane_ - a[axis_]) / (b[axis_] - a[axis_]));
    p[axis_] = plane_;
    edges_[count_] = {low, high, add_corner(below_, p), add_corner(above_, p), kCuts};
    return count_++;
  }

  static bool push(Face& face, std::size_t& size, std::uint8_t corner) {
    if (size == kFaceCorners) return false;
    face[size++] = corner;
    return true;
  }

  bool cut_face(const Face& face, std::size_t size) {
    Face low, high;
    std::size_t low_size = 0, high_size = 0;
    std::size_t leaves = kCuts, enters = kCuts;  // the points where the face leaves the part below, and comes back
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t u = face[i];
      const std::size_t w = face[i + 1 == size ? 0 : i + 1];
      if (!(is_below_[u] ? push(low, low_size, number_[u]) : push(high, high_size, number_[u]))) return false;
      if (is_below_[u] == is_below_[w]) continue;
      std::size_t& end = is_below_[u] ? leaves : enters;
      if (end != kCuts) return false;
      end = point_between(u, w);
      if (end == kCuts) return false;
      if (!push(low, low_size, edges_[end].in_below) || !push(high, high_size, edges_[end].in_above)) return false;
    }
    if (leaves != kCuts) edges_[enters].next = leaves;
    return add_face(below_, low, low_size) && add_face(above_, high, high_size);
  }

  static bool add_face(Piece& part, const Face& face, std::size_t size) {
    if (size < 3) return true;
    if (part.face_count_ == kFaces) return false;
    part.sizes_[part.face_count_] = static_cast<std::uint8_t>(size);
    part.faces_[part.face_count_++] = face;
    return true;
  }

  /// Adds the faces in the plane.
  bool close() {
    Face low, high;
    std::size_t size = 0;
    for (std::size_t e = 0; size < count_; e = edges_[e].next) {
      if (e == kCuts || (e == 0 && size > 0)) return false;
      low[size] = edges_[e].in_below;
      high[count_ - 1 - size] = edges_[e].in_above;
      ++size;
    }
    return add_face(below_, low, size) && add_face(above_, high, size);
  }

  const Piece& whole_;
  int axis_;
  double plane_;
  Piece& below_;
  Piece& above_;
  std::array<bool, kCorners> is_below_;
  std::array<std::uint8_t, kCorners> number_;
  std::array<CutEdge, kCuts> edges_;
  std::size_t count_ = 0;
};

Piece::Piece(const IndexTet& tet) : corner_count_(4), face_count_(4) {
  std::copy(tet.begin(), tet.end(), corners_.begin());
  constexpr std::uint8_t kFacesOfTet[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (std::size_t f = 0; f < 4; ++f) {
    sizes_[f] = 3;
    std::copy(std::begin(kFacesOfTet[f]), std::end(kFacesOfTet[f]), faces_[f].begin());
  }
}

std::array<double, 2> Piece::range(int axis) const {
  double low = corners_[0][axis];
  double high = low;
  for (std::size_t i = 1; i < corner_count_; ++i) {
    low = std::min(low, corners_[i][axis]);
    high = std::max(high, corners_[i][axis]);
  }
  return {low, high};
}

bool Piece::cut(int axis, double plane, Piece& below, Piece& above) const {
  return Cut(*this, axis, plane, below, above).make();
}

}  // namespace scantet
