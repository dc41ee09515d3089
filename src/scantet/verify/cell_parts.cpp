// A cell is swept along z. In the slice at t the field is bilinear, with values at the four corners that are linear in
// t: those along the vertical edges A = (0, 4), B = (1, 5), C = (2, 6) and D = (3, 7). A piece of the part in a slice
// holds a corner of the slice (a bilinear function has no extremum within a square), and is contractible. So the number
// of pieces is
//   n(t) = corners in the part - sides with both ends in it - [diagonal joined] + [all four in it],
// where a diagonal counts if its ends are in the part, the others are not, and the saddle is. The Euler number of the
// part is the integral of n over t with respect to the Euler characteristic: a closed interval of t counts 1, a
// half-open one 0, an open one -1. Along edges the part is one interval, as is that of each set of corners that are in
// the part together; the saddle A·D - B·C is quadratic in t, so that diagonals are joined in at most two. All that is
// asked for is the order of the roots of linear functions, which is the sign of a difference of products, and whether a
// quadratic changes its sign twice within an interval, which intervals decide.
#include "scantet/verify/cell_parts.h"

#include <algorithm>

#include "scantet/verify/exact_sign.h"
#include "scantet/verify/interval.h"

namespace scantet::verify {
namespace {

enum class End {
  face,
  own,
  other
};  // what bounds a stretch of t: a face of the cell, a corner of the diagonal, or of
    // the other diagonal

struct Bound {
  End kind = End::face;
  int edge = 0;   // whose root it is
  int tied = -1;  // an edge of the other diagonal that has the same root; then kind is own
};

class Sweep {
 public:
  Sweep(const std::array<double, 8>& values, double level, int side) : v_(values), level_(level), side_(side) {
    for (int c = 0; c < 8; ++c) part_.members |= static_cast<std::uint8_t>(is_in(c) << c);
    for (std::uint8_t c = 0; c < 8; ++c) part_.piece[c] = c;
  }

  CellPart run() {
    int corners_with_part = 0;
    bool all_overlap = true;
    for (int e = 0; e < 4; ++e) {
      if (is_in(e) && is_in(e + 4)) join(e, e + 4);
      corners_with_part += has(e);
      for (int f = e + 1; f < 4; ++f) {
        const bool both = overlap(e, f);
        all_overlap = all_overlap && both;
        if (both && e + f != 3) {
          join(corner(e), corner(f));
          add(e, -1);
        }
      }
      if (has(e)) add(e, 1);
    }
    if (corners_with_part == 4 && all_overlap) add(0, 1);
    diagonal(0, 3, 1, 2);
    diagonal(1, 2, 0, 3);
    for (int c = 0; c < 8; ++c) {
      part_.euler[part_.piece[at(c)]] = static_cast<std::int8_t>(part_.euler[part_.piece[at(c)]] + added_[at(c)]);
    }
    return part_;
  }

 private:
  static std::size_t at(int c) { return static_cast<std::size_t>(c); }
  bool is_in(int c) const { return side_ > 0 ? v_[at(c)] > level_ : v_[at(c)] < level_; }
  bool has(int e) const { return is_in(e) || is_in(e + 4); }
  /// A corner of the vertical edge that is in the part.
  int corner(int e) const { return is_in(e) ? e : e + 4; }
  void add(int e, int euler) { added_[at(corner(e))] = static_cast<std::int8_t>(added_[at(corner(e))] + euler); }
  int saddle(int a, int d, int b, int c) const {
    return sign_of_saddle(v_[at(a)], v_[at(d)], v_[at(b)], v_[at(c)], level_);
  }

  void note_tie(bool is_tied) { part_.has_tied_saddle = part_.has_tied_saddle || is_tied; }

  void join(int a, int b) {
    const std::uint8_t from = std::max(part_.piece[at(a)], part_.piece[at(b)]);
    const std::uint8_t to = std::min(part_.piece[at(a)], part_.piece[at(b)]);
    std::replace(part_.piece.begin(), part_.piece.end(), from, to);
  }

  /// Whether both edges are in the part at some t.
  bool overlap(int e, int f) {
    if (!has(e) || !has(f)) return false;
    if ((is_in(e) && is_in(f)) || (is_in(e + 4) && is_in(f + 4))) return true;
    const int sign = is_in(e) ? saddle(e, f + 4, e + 4, f) : saddle(e + 4, f, e, f + 4);
    note_tie(sign == 0 && e + f != 3);
    return sign > 0;
  }

  /// Where the heights of two edges are zero: -1 if e's is before f's. Both change sides.
  int compare_roots(int e, int f) const {
    const int turned = ((v_[at(e)] > v_[at(e + 4)]) == (v_[at(f)] > v_[at(f + 4)])) ? 1 : -1;
    return -turned * saddle(e, f + 4, f, e + 4);
  }

  /// Moves a bound of the stretch to the root of e, if that is further in. way: 1 for the lower bound. Of equal roots
  /// that of the diagonal itself is: {height ≥ ε} is a little less than {height ≥ 0}.
  void tighten(Bound& bound, int e, End kind, int way) const {
    const int order = bound.kind == End::face ? -1 : way * compare_roots(bound.edge, e);
    if (order < 0) {
      bound = {kind, e, -1};
    } else if (order == 0 && bound.kind != kind) {
      bound = kind == End::own ? Bound{End::own, e, bound.edge} : Bound{End::own, bound.edge, e};
    }
  }

  /// The stretch of t in which a and d are in the part, and b and c are not; whether there is one.
  bool stretch(const std::array<int, 4>& e, Bound& low, Bound& high) {
    for (const int own : {e[0], e[1]}) {
      if (!has(own)) return false;
      if (!is_in(own)) tighten(low, own, End::own, 1);
      if (!is_in(own + 4)) tighten(high, own, End::own, -1);
    }
    for (const int other : {e[2], e[3]}) {
      if (is_in(other) && is_in(other + 4)) return false;
      if (is_in(other)) tighten(low, other, End::other, 1);
      if (is_in(other + 4)) tighten(high, other, End::other, -1);
    }
    if (low.kind == End::face || high.kind == End::face) return true;
    const int order = compare_roots(low.edge, high.edge);
    note_tie(order == 0);
    // Where both others are zero at one t, the diagonal is joined there, over a stretch as short as ε is small. Where
    // the diagonal itself is, it is not.
    return order < 0 || (order == 0 && low.kind == End::other && high.kind == End::other);
  }

  void diagonal(int a, int d, int b, int c) {
    const std::array<int, 4> e{a, d, b, c};
    Bound low;
    Bound high;
    if (!stretch(e, low, high)) return;
    if (low.tied >= 0 || high.tied >= 0) {
      note_tie(true);
      tied_diagonal(e, low, high);
      return;
    }
    const int first = saddle(a, d, b, c);
    const int last = saddle(a + 4, d + 4, b + 4, c + 4);
    note_tie((low.kind == End::face && first == 0) || (high.kind == End::face && last == 0));
    const bool at_low = low.kind == End::face ? first > 0 : low.kind == End::other;
    const bool at_high = high.kind == End::face ? last > 0 : high.kind == End::other;
    bool twice = false;
    if (at_low == at_high &&
        !(low.kind == End::other && high.kind == End::other && compare_roots(low.edge, high.edge) == 0)) {
      const Zeros zeros{low.kind == End::face && first == 0, high.kind == End::face && last == 0};
      twice = changes_twice(e, low, high, at_low, zeros);
    }
    if (!at_low && !at_high && !twice) return;
    // Stretches in which the diagonal is joined, each closed but at ends of the kind `other`.
    const int open = (at_low && low.kind == End::other) + (at_high && high.kind == End::other);
    join_diagonal(e, at_low && at_high && twice ? 2 : 1, open);
  }

  void join_diagonal(const std::array<int, 4>& e, int stretches, int open) {
    join(corner(e[0]), corner(e[1]));
    add(e[0], open - stretches);
  }

  /// Where X of the diagonal and Y of the other are zero at one t, Y is a multiple of X, and the saddle is X times a
  /// linear function, which has the saddle's sign within the stretch.
  void tied_diagonal(const std::array<int, 4>& e, const Bound& low, const Bound& high) {
    const Bound& tie = low.tied >= 0 ? low : high;
    const int partner = tie.edge == e[0] ? e[1] : e[0];
    const int other = tie.tied == e[2] ? e[3] : e[2];
    const double node = is_in(tie.edge) ? 0 : 1;
    const Interval x = height(tie.edge, node);
    const Interval y = height(tie.tied, node);
    const auto sign = [&](const Bound& bound, double face) {
      const Interval t =
          bound.kind == End::face ? Interval(face) : Interval(root_of(bound.edge) - 1e-12, root_of(bound.edge) + 1e-12);
      const Interval line = x * height(partner, t) - y * height(other, t);
      if (!line.is_positive() && !line.is_negative()) part_.is_known = false;
      return line.is_positive();
    };
    // A second tie is one of the other two: the linear function is zero there, and of one sign within.
    const bool both = low.tied >= 0 && high.tied >= 0;
    if (both) {
      const double middle = 0.5 * (root_of(low.edge) + root_of(high.edge));
      const Interval q = polar(e, middle, middle);
      if (!q.is_positive() && !q.is_negative()) part_.is_known = false;
      if (q.is_positive()) join_diagonal(e, 1, 0);
      return;
    }
    const bool at_low = sign(low, 0);
    const bool at_high = sign(high, 1);
    if (!at_low && !at_high) return;
    join_diagonal(e, 1, (at_low && low.kind == End::other) + (at_high && high.kind == End::other));
  }

  Interval height(int e, const Interval& t) const {
    const Interval low = Interval(v_[at(e)]) - level_;
    const Interval high = Interval(v_[at(e + 4)]) - level_;
    const Interval h = low + t * (high - low);
    return side_ > 0 ? h : -h;
  }
  Interval polar(const std::array<int, 4>& e, double s, double t) const {
    const auto product = [&](int x, int y) { return height(x, s) * height(y, t) + height(x, t) * height(y, s); };
    return product(e[0], e[1]) - product(e[2], e[3]);
  }
  double root_of(int e) const { return (v_[at(e)] - level_) / ((v_[at(e)] - level_) - (v_[at(e + 4)] - level_)); }

  struct Zeros {
    bool from;
    bool to;
  };
  /// Whether the saddle, which is positive (or not) at both ends of a stretch, is of the other sign in between. zeros:
  /// at which ends it is zero.
  bool changes_twice(const std::array<int, 4>& e, const Bound& low, const Bound& high, bool positive,
                     const Zeros& zeros) {
    // Beyond a root that bounds the stretch the sign stays what it is at the root, so that rounding does no harm.
    const double from = low.kind == End::face ? 0 : std::clamp(root_of(low.edge) - 1e-12, 0.0, 1.0);
    const double to = high.kind == End::face ? 1 : std::clamp(root_of(high.edge) + 1e-12, 0.0, 1.0);
    steps_ = 500;
    return search(e, from, to, positive, zeros, 40);
  }
  bool search(const std::array<int, 4>& e, double from, double to, bool positive, const Zeros& zeros, int depth) {
    const auto sign = [&](const Interval& q) {
      return q.is_positive() ? (positive ? 1 : -1) : q.is_negative() ? (positive ? -1 : 1) : 0;
    };
    if ((zeros.from || sign(polar(e, from, from)) > 0) && sign(polar(e, from, to)) > 0 &&
        (zeros.to || sign(polar(e, to, to)) > 0)) {
      return false;
    }
    const double middle = 0.5 * (from + to);
    if (sign(polar(e, middle, middle)) < 0 && height(e[0], middle).is_positive() &&
        height(e[1], middle).is_positive() && height(e[2], middle).is_negative() &&
        height(e[3], middle).is_negative()) {
      return true;
    }
    if (depth == 0 || --steps_ < 0) {
      part_.is_known = false;
      return false;
    }
    return search(e, from, middle, positive, {zeros.from, false}, depth - 1) ||
           search(e, middle, to, positive, {false, zeros.to}, depth - 1);
  }

  const std::array<double, 8>& v_;
  double level_;
  int side_;
  CellPart part_;
  int steps_ = 0;                       // of a search that are left
  std::array<std::int8_t, 8> added_{};  // Euler numbers, at corners, before pieces are known
};

}  // namespace

CellPart part_in_cell(const std::array<double, 8>& values, double level, int side) {
  return Sweep(values, level, side).run();
}

int pieces_in_low_face(const std::array<double, 8>& values, double level, int side, int axis,
                       std::array<int, 2>& corners) {
  std::array<int, 4> face{};
  unsigned in = 0;
  int some = 0;
  for (int n = 0; n < 4; ++n) {
    face[static_cast<std::size_t>(n)] = face_corner(axis, 0, n);
    const double v = values[static_cast<std::size_t>(face[static_cast<std::size_t>(n)])];
    if (side > 0 ? v > level : v < level) {
      in |= 1U << n;
      some = n;
    }
  }
  if (in == 0) return 0;
  corners = {face[static_cast<std::size_t>(some)], 0};
  if (in != 6 && in != 9) return 1;
  const std::size_t a = in == 9 ? 0 : 1;
  const auto v = [&](std::size_t n) { return values[static_cast<std::size_t>(face[n])]; };
  corners = {face[a], face[3 - a]};
  return sign_of_saddle(v(a), v(3 - a), v(a ^ 1), v((3 - a) ^ 1), level) > 0 ? 1 : 2;
}

}  // namespace scantet::verify
