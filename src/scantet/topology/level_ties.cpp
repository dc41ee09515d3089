// Let Q be {h > 0} or {h < 0}, and b(x) a small ball around a point x. The Euler number of Q is the integral, in the
// sense of Euler numbers, of that of Q ∩ b(x) over the closure of Q. The part wanted has a point for each of its pieces
// at x, so its Euler number is the integral of their number. The two differ only where nodes are at the level: at such
// nodes, along edges between them, and in faces between them. There the difference is summed up: along an open edge it
// counts -1 times, in an open face once.
//
// What is at a node is read off a small sphere around it (tie_signs.h), and so is what is at a point of an edge where a
// sign beside it changes.
#include "scantet/topology/level_ties.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "scantet/base/neighbors.h"
#include "scantet/field/run_sweep.h"
#include "scantet/topology/cell_euler.h"
#include "scantet/topology/tie_signs.h"
#include "scantet/topology/wall_lines.h"
#include "scantet/topology/wall_overlap.h"

namespace scantet {
namespace {

using Node = std::array<int, 3>;

class Ties {
 public:
  Ties(const HeightGrid& heights, const TieSink& add)
      : heights_(heights), add_(add), little_below_(little_below(heights)) {}

  /// sweep: with the node's layer in the middle of the last three.
  void count_at(const Node& node, const RunSweep& sweep) {
    sweep_ = &sweep;
    const auto height_at = [&](int octant, int axes) {
      Node cell = node;
      int corner = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const bool high = (octant >> axis & 1) != 0;
        if (!high) --cell[axis];
        if (high == ((axes >> axis & 1) != 0)) corner |= 1 << axis;
      }
      return height_in(cell, corner);
    };
    Signs signs(height_at);
    for (const Node step : kNeighborhood) {
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
  double height(const Node& node) const { return lowered(heights_.height(node[0], node[1], node[2]), node); }
  /// Of a corner of a cell, as it was read, unless it has been turned to the other side since.
  double height_in(const Node& cell, int corner) const {
    const Node node = moved(cell, {corner & 1, corner >> 1 & 1, corner >> 2});
    const double read = heights_.field_corners(cell[0], cell[1], cell[2])[corner];
    const double now = heights_.height(node[0], node[1], node[2]);
    return lowered((read > 0) == (now > 0) && (read < 0) == (now < 0) ? read : now, node);
  }
  double lowered(double height, const Node& node) const {
    if (height != 0) return height;
    return sign_in(sweep_->layer(sweep_->k() - node[2]), node[0], node[1]) < 0 ? -little_below_ : 0;
  }

  /// node_of(octant, axes, q): the node of sign q that stands for that neighbour.
  template <class NodeOf>
  void count_node(const Signs& signs, const NodeOf& node_of) {
    for (const int q : {1, -1}) {
      signs.pieces(q).for_each([&](int octant, int eighths) {
        if (eighths != 8) add_(node_of(octant, signs.axes_of(octant, q), q), 8 - eighths);
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
      count_change(axis, t, steps, ends, here, node_at);
    }
  }

  template <class RealNode>
  void count_stretch(const std::array<int, 8>& now, const RealNode& real_node) {
    const Around around{{now[0], now[1], now[2], now[3]}, {now[4], now[5], now[6], now[7]}};
    for (const int q : {1, -1}) {
      around.pieces(q).for_each([&](int n, int eighths) {
        if (eighths == 8) return;
        const int next = (n + 1) % 4;
        add_(real_node(now[n] == q ? n : now[next] == q ? next : 4 + n, q), eighths - 8);
      });
    }
  }

  /// A point of the edge where a sign changes.
  template <class NodeAt>
  void count_change(int axis, double t, const std::array<Node, 8>& steps, const std::array<std::array<int, 2>, 8>& ends,
                    const std::array<int, 8>& here, const NodeAt& node_at) {
    const auto place_of = [&](Node step) {
      step[axis] = 0;
      return static_cast<int>(std::find(steps.begin(), steps.end(), step) - steps.begin());
    };
    const auto height_at = [&](int octant, int axes) {
      Node cell = node_at(0, 0);
      --cell[(axis + 1) % 3];  // the lower end of the edge
      int corner = 0;
      for (int other = 0; other < 3; ++other) {
        if (other == axis) continue;
        const bool high = (octant >> other & 1) != 0;
        if (!high) --cell[other];
        if (high == ((axes >> other & 1) != 0)) corner |= 1 << other;
      }
      const int along = 1 << axis;
      if ((axes & along) != 0) return height_in(cell, corner | (octant & along));
      if (here[place_of(Signs::step(octant, axes))] == 0) return 0.0;
      return mix(height_in(cell, corner), height_in(cell, corner | along), t);
    };
    Signs signs(height_at, 1 << axis);
    for (int n = 0; n < 8; ++n) {
      Node step = steps[n];
      signs.at(step) = here[n];
      step[axis] = -1;
      signs.at(step) = ends[n][0];
      step[axis] = 1;
      signs.at(step) = ends[n][1];
    }
    count_node(signs, [&](int octant, int axes, int q) {
      const Node step = Signs::step(octant, axes);
      const int along = step[axis];
      const int n = place_of(step);
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
      std::array<WallHeights, 2> beside;  // across the face, above zero in the part
      std::optional<Node> node;
      for (const int side : {0, 1}) {
        Node cell = low;
        if (side == 0) --cell[axis];
        for (int n = 0; n < 4; ++n) {
          Node step = corners[n];
          step[axis] = side;
          beside[side][n] = q * height_in(cell, step[0] | step[1] << 1 | step[2] << 2);
          step[axis] = 2 * side - 1;
          if (signs.at(step) == q) node = moved(low, step);
        }
      }
      if (!node) continue;
      const int eighths = -8 * euler_of_overlap(beside[0], beside[1]) + (q < 0 ? wall_line_shares(beside) : 0);
      if (eighths != 0) add_(*node, eighths);
    }
  }

  const HeightGrid& heights_;
  const TieSink& add_;
  double little_below_;
  const RunSweep* sweep_ = nullptr;
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
