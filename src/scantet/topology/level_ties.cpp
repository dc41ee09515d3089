// Let Q be {h > 0} or {h < 0}, and b(x) a small ball around a point x. The Euler number of Q is the integral, in the
// sense of Euler numbers, of that of Q ∩ b(x) over the closure of Q. The part wanted has a point for each of its pieces
// at x, so its Euler number is the integral of their number. The two differ only where nodes are at the level: at such
// nodes, along edges between them, and in faces between them. There the difference is summed up: along an open edge it
// counts -1 times, in an open face once.
//
// At a node the sphere around it falls into eight octants, one a cell, with twelve arcs and six poles between them. The
// sign at a pole is that of the neighbour there; on an arc, where both poles are at the level, that of the node across
// the face; and so on. Of either sign there is one piece in an octant at most, for there h is, to leading order, linear
// in the coordinates, or in their inverses, or is their product. A point of an edge where the sign beside it changes is
// like a node.
#include "scantet/topology/level_ties.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "scantet/field/run_sweep.h"

namespace scantet {
namespace {

using Node = std::array<int, 3>;

/// Up to eight pieces of a sphere or circle, joined to parts, with their Euler numbers.
class Pieces {
 public:
  Pieces() {
    for (int n = 0; n < 8; ++n) part_[n] = n;
  }
  void add(int piece) {
    exists_ |= 1U << piece;
    ++euler_[piece];
  }
  bool exists(int piece) const { return (exists_ >> piece & 1) != 0; }
  /// What the pieces overlap in counts once too often, or (euler > 0) too rarely.
  void correct(int piece, int euler) { euler_[piece] += euler; }
  void join(int a, int b) {
    const int from = part_[b];
    const int to = part_[a];
    std::replace(part_.begin(), part_.end(), from, to);
  }
  void join_all() {
    const int first = std::countr_zero(exists_);
    for (int n = 0; n < 8; ++n) {
      if (exists(n)) join(first, n);
    }
  }
  /// The parts there are.
  int count() const {
    int parts = 0;
    for_each([&](int, int) { ++parts; });
    return parts;
  }
  /// Calls visit(piece, euler) for each part, with one of its pieces.
  template <class Visit>
  void for_each(const Visit& visit) const {
    std::array<int, 8> sum{};
    std::array<int, 8> piece{};
    unsigned parts = 0;
    for (int n = 0; n < 8; ++n) {
      if (!exists(n)) continue;
      sum[part_[n]] += euler_[n];
      piece[part_[n]] = n;
      parts |= 1U << part_[n];
    }
    for (; parts != 0; parts &= parts - 1) visit(piece[std::countr_zero(parts)], sum[std::countr_zero(parts)]);
  }

 private:
  std::array<int, 8> part_{};
  std::array<int, 8> euler_{};
  unsigned exists_ = 0;
};

/// Signs in the four directions across an edge at the level, in their order around it, and between each and the next.
struct Around {
  std::array<int, 4> beside;
  std::array<int, 4> between;

  /// What has the sign q there, by quadrants.
  Pieces pieces(int q) const {
    Pieces pieces;
    for (int n = 0; n < 4; ++n) {
      const int next = beside[(n + 1) % 4];
      if (beside[n] == q || next == q || (beside[n] == 0 && next == 0 && between[n] == q)) pieces.add(n);
    }
    for (int n = 0; n < 4; ++n) {
      const int last = (n + 3) % 4;
      if (beside[n] == q) pieces.correct(n, -1);
      if (beside[n] == q || (beside[n] == 0 && pieces.exists(n) && pieces.exists(last))) pieces.join(n, last);
    }
    if (q < 0 && pieces.count() > 1) pieces.join_all();
    return pieces;
  }
};

/// The signs of the 26 neighbours of a node at the level.
class Signs {
 public:
  int& at(const Node& step) { return signs_[step[0] + 1 + 3 * (step[1] + 1) + 9 * (step[2] + 1)]; }
  int at(const Node& step) const { return signs_[step[0] + 1 + 3 * (step[1] + 1) + 9 * (step[2] + 1)]; }

  /// The neighbour of an octant (bit set: the high side) along the axes of a mask.
  static Node step(int octant, int axes) {
    Node step{};
    for (int axis = 0; axis < 3; ++axis) {
      if (axes >> axis & 1) step[axis] = octant >> axis & 1 ? 1 : -1;
    }
    return step;
  }

  /// The axes of a neighbour of the octant that has the sign q, and whose sign the octant has in some part; 0 if none.
  int axes_of(int octant, int q) const {
    const auto sign = [&](int axes) { return at(step(octant, axes)); };
    for (const int axes : {1, 2, 4}) {
      if (sign(axes) == q) return axes;
    }
    for (const int axes : {3, 5, 6}) {
      if (sign(axes) != q) continue;
      const int low = axes & -axes;
      if (sign(low) == 0 && sign(axes ^ low) == 0) return axes;
    }
    for (int axes = 1; axes < 7; ++axes) {
      if (sign(axes) != 0) return 0;
    }
    return sign(7) == q ? 7 : 0;
  }

  /// What has the sign q, by octants.
  Pieces pieces(int q) const {
    Pieces pieces;
    for (int octant = 0; octant < 8; ++octant) {
      if (axes_of(octant, q) != 0) pieces.add(octant);
    }
    for (int third = 1; third < 8; third <<= 1) {
      for (int octant = 0; octant < 8; ++octant) {
        if ((octant & third) == 0) join_over_arc(octant, third, q, pieces);
      }
      for (const int side : {0, third}) {
        if (at(step(side, third)) == q) pieces.correct(side, 1);
      }
    }
    for (int axis = 0; q < 0 && axis < 3; ++axis) {
      for (const int side : {0, 1}) join_at_pole(axis, side, pieces);
    }
    return pieces;
  }

 private:
  /// octant: the one on the low side of the arc.
  void join_over_arc(int octant, int third, int q, Pieces& pieces) const {
    const int both = 7 ^ third;
    const int u = both & -both;
    const int v = both ^ u;
    const int a = at(step(octant, u));
    const int b = at(step(octant, v));
    const int d = at(step(octant, both));
    if (a == q || b == q || (a == 0 && b == 0 && d == q)) {
      pieces.correct(octant, -1);
      pieces.join(octant, octant | third);
    } else if (a == 0 && b == 0 && d == 0 && (reach(octant, u, v, q) & reach(octant | third, u, v, q)) != 0) {
      pieces.join(octant, octant | third);
    }
  }

  /// Which ends of an arc at the level what has the sign q reaches in the octant: bit 0 that at u, bit 1 that at v.
  int reach(int octant, int u, int v, int q) const {
    const int third = 7 ^ u ^ v;
    const auto sign = [&](int axes) { return at(step(octant, axes)); };
    if (sign(third) != 0) return sign(third) == q ? 3 : 0;
    const int near_u = sign(third | u);
    const int near_v = sign(third | v);
    if (near_u == 0 && near_v == 0) return sign(7) == q ? 3 : 0;
    return (near_u == q || (near_u == 0 && near_v == q) ? 1 : 0) |
           (near_v == q || (near_v == 0 && near_u == q) ? 2 : 0);
  }

  /// Joins parts below that touch along an edge at the level.
  void join_at_pole(int axis, int side, Pieces& pieces) const {
    const int pole = side << axis;
    if (at(step(pole, 1 << axis)) != 0) return;
    const int u = 1 << (axis + 1) % 3;
    const int v = 1 << (axis + 2) % 3;
    const std::array<int, 4> octants{pole | u | v, pole | v, pole, pole | u};
    const std::array<int, 4> beyond{u, v, u, v};  // of each octant, the direction that it begins with
    Around around{};
    for (int n = 0; n < 4; ++n) {
      const int near = at(step(octants[n], beyond[n]));
      around.beside[n] = near != 0 ? near : at(step(octants[n], beyond[n] | 1 << axis));
      const int across = at(step(octants[n], u | v));
      around.between[n] = across != 0 ? across : at(step(octants[n], 7));
    }
    const Pieces found = around.pieces(-1);
    if (found.count() != 1) return;
    int first = -1;
    for (int n = 0; n < 4; ++n) {
      if (!found.exists(n) || !pieces.exists(octants[n])) continue;
      if (first < 0) first = octants[n];
      pieces.join(first, octants[n]);
    }
  }

  std::array<int, 27> signs_{};
};

class Ties {
 public:
  Ties(const HeightGrid& heights, const TieSink& add) : heights_(heights), add_(add) {}

  /// sweep: with the node's layer in the middle of the last three.
  void count_at(const Node& node, const RunSweep& sweep) {
    Signs signs;
    for (int n = 0; n < 27; ++n) {
      const Node step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      signs.at(step) = sign_in(sweep.layer(1 - step[2]), node[0] + step[0], node[1] + step[1]);
    }
    count_node(signs, [&](int octant, int axes, int) { return moved(node, Signs::step(octant, axes)); });
    for (int axis = 0; axis < 3; ++axis) {
      Node step{};
      step[axis] = 1;
      if (signs.at(step) == 0) count_edge(node, axis, signs);
      count_face(node, axis, signs);
    }
  }

 private:
  /// A change of sign along an edge: beside it (0 … 3), or between two directions (4 … 7).
  struct Change {
    double t;
    int where;
  };

  static int sign_in(const RunLayer& layer, int i, int j) {
    const int p = i + 1;
    const auto bit = [&](const SignLayer& signs) { return signs.row_signs(j + 1)[p / 64] >> p % 64 & 1; };
    return bit(layer) != 0 ? 1 : bit(layer.reached) != 0 ? 0 : -1;
  }
  static Node moved(Node node, const Node& step) {
    for (int axis = 0; axis < 3; ++axis) node[axis] += step[axis];
    return node;
  }
  double height(const Node& node) const { return heights_.height(node[0], node[1], node[2]); }

  /// node_of(octant, axes, q): the node of sign q that stands for that neighbour.
  template <class NodeOf>
  void count_node(const Signs& signs, const NodeOf& node_of) {
    for (const int q : {1, -1}) {
      signs.pieces(q).for_each([&](int octant, int euler) {
        if (euler != 1) add_(node_of(octant, signs.axes_of(octant, q), q), 1 - euler);
      });
    }
  }

  /// Four directions across an axis, in their order around it, and the diagonals between; ends: of the edge.
  void count_edge(const Node& low, int axis, const Signs& signs) {
    std::array<Node, 8> steps{};
    for (int n = 0; n < 4; ++n) {
      steps[n][(axis + 1 + n % 2) % 3] = n < 2 ? 1 : -1;
    }
    for (int n = 0; n < 4; ++n) steps[4 + n] = moved(steps[n], steps[(n + 1) % 4]);
    std::array<std::array<int, 2>, 8> ends;
    std::vector<Change> changes;
    const auto node_at = [&](int n, int end) {
      Node node = moved(low, steps[n]);
      node[axis] += end;
      return node;
    };
    for (int n = 0; n < 8; ++n) {
      Node step = steps[n];
      ends[n][0] = signs.at(step);
      step[axis] = 1;
      ends[n][1] = signs.at(step);
      if (ends[n][0] * ends[n][1] >= 0) continue;
      const double from = height(node_at(n, 0));
      changes.push_back({from / (from - height(node_at(n, 1))), n});
    }
    std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.t < b.t; });

    std::array<int, 8> now;  // the signs in the stretch that has been reached
    for (int n = 0; n < 8; ++n) now[n] = ends[n][0] != 0 ? ends[n][0] : ends[n][1];
    const auto real_node = [&](int n, int q) { return node_at(n, ends[n][0] == q ? 0 : 1); };
    for (auto change = changes.begin();;) {
      count_stretch(now, real_node);
      if (change == changes.end()) return;
      std::array<int, 8> here = now;
      const double t = change->t;
      for (; change != changes.end() && change->t == t; ++change) {
        here[change->where] = 0;
        now[change->where] = ends[change->where][1];
      }
      count_change(axis, steps, ends, here, node_at);
    }
  }

  template <class RealNode>
  void count_stretch(const std::array<int, 8>& now, const RealNode& real_node) {
    const Around around{{now[0], now[1], now[2], now[3]}, {now[4], now[5], now[6], now[7]}};
    for (const int q : {1, -1}) {
      around.pieces(q).for_each([&](int n, int euler) {
        if (euler == 1) return;
        const int next = (n + 1) % 4;
        add_(real_node(now[n] == q ? n : now[next] == q ? next : 4 + n, q), euler - 1);
      });
    }
  }

  /// A point of the edge where a sign changes.
  template <class NodeAt>
  void count_change(int axis, const std::array<Node, 8>& steps, const std::array<std::array<int, 2>, 8>& ends,
                    const std::array<int, 8>& here, const NodeAt& node_at) {
    Signs signs;
    for (int n = 0; n < 8; ++n) {
      Node step = steps[n];
      signs.at(step) = here[n];
      step[axis] = -1;
      signs.at(step) = ends[n][0];
      step[axis] = 1;
      signs.at(step) = ends[n][1];
    }
    count_node(signs, [&](int octant, int axes, int q) {
      Node step = Signs::step(octant, axes);
      const int along = step[axis];
      step[axis] = 0;
      const auto n = static_cast<int>(std::find(steps.begin(), steps.end(), step) - steps.begin());
      return node_at(n, along != 0 ? (along > 0 ? 1 : 0) : ends[n][0] == q ? 0 : 1);
    });
  }

  /// The face across an axis that the node is the lowest corner of, if all its corners are at the level.
  void count_face(const Node& low, int axis, const Signs& signs) {
    std::array<Node, 4> corners{};
    for (int n = 0; n < 4; ++n) {  // around the face
      corners[n][(axis + 1) % 3] = n == 1 || n == 2 ? 1 : 0;
      corners[n][(axis + 2) % 3] = n >= 2 ? 1 : 0;
      if (n > 0 && signs.at(corners[n]) != 0) return;
    }
    for (const int q : {1, -1}) {
      std::array<bool, 2> whole{};
      std::array<int, 2> saddle{};
      Node node{};
      for (const int side : {0, 1}) {
        std::array<double, 4> h{};
        int in = 0;
        int out = 0;
        for (int n = 0; n < 4; ++n) {
          Node step = corners[n];
          step[axis] = 2 * side - 1;
          const int sign = signs.at(step);
          h[n] = height(moved(low, step));
          if (sign == q) node = moved(low, step);
          in += sign == q ? 1 : 0;
          out += sign == -q ? 1 : 0;
        }
        whole[side] = in > 0 && out == 0;
        const double product = h[0] * h[2] - h[1] * h[3];
        const bool alternates = in == 2 && out == 2 && h[0] * h[2] > 0 && h[1] * h[3] > 0;
        saddle[side] = alternates && product != 0 && (product > 0) == (q * h[0] > 0) ? 1 : 0;
      }
      if (whole[0] && whole[1]) {
        add_(node, -1);
      } else if ((whole[0] && saddle[1] != 0) || (whole[1] && saddle[0] != 0)) {
        add_(node, 1);
      }
    }
  }

  const HeightGrid& heights_;
  const TieSink& add_;
};

}  // namespace

void count_ties(const HeightGrid& heights, int first, int last, const Progress& progress, const TieSink& add) {
  Ties ties(heights, add);
  RunSweep sweep(heights, std::max(first - 1, -1), std::min(last, heights.size()[2]));
  const auto begin = std::max(first, 0);
  while (!progress.cancelled() && sweep.advance(nullptr)) {
    const int k = sweep.k() - 1;
    if (k < begin || k >= last || !sweep.layer(1).has_zeros) continue;
    const RunLayer& layer = sweep.layer(1);
    for (int row = 1; row + 1 < layer.rows; ++row) {
      if (!layer.reached.some[row]) continue;
      for (int w = 0; w < layer.words; ++w) {
        std::uint64_t zeros = layer.reached.row_signs(row)[w] & ~layer.row_signs(row)[w];
        for (; zeros != 0; zeros &= zeros - 1) ties.count_at({64 * w + std::countr_zero(zeros) - 1, row - 1, k}, sweep);
      }
    }
  }
}

}  // namespace scantet
