// Each cell near the level looks at its low corner, its three low faces and its inside. Ways from several saddles climb
// along the same edges of the grid, so these are listed apart, and each once.
#include "scantet/topology/narrow_ways.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "scantet/base/large_pages.h"
#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
#include "scantet/topology/near_level.h"
#include "scantet/topology/trilinear_saddles.h"

namespace scantet {
namespace {

constexpr double kAtLevel = 1e-6;  // of the heights around: a saddle nearer the level has no width to speak of

using Node = std::array<int, 3>;

Vec as_index(const Node& n) {
  return {double(n[0]), double(n[1]), double(n[2])};
}

Node corner_of(const Node& cell, int corner) {
  return {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)};
}

/// The least height on the way from a saddle to a corner of its cell, where the function is value + square·t² +
/// cube·t³.
double lowest_on_leg(const CellHeights& h, const Saddle& saddle, int corner) {
  const Vec d = as_index(corner_of({0, 0, 0}, corner)) - saddle.position;
  const double square = saddle.mixed[0] * d.y * d.z + saddle.mixed[1] * d.x * d.z + saddle.mixed[2] * d.x * d.y;
  const double cube = h[corner] - saddle.value - square;
  double lowest = std::min(saddle.value, h[corner]);
  if (square < 0 && cube > 0) {
    const double t = std::min(1.0, -2 * square / (3 * cube));
    lowest = std::min(lowest, saddle.value + t * t * (square + t * cube));
  }
  return lowest;
}

template <std::size_t N>
bool is_above_level(double saddle, const std::array<double, N>& around) {
  double scale = 0;
  for (const double h : around) scale = std::max(scale, std::abs(h));
  return saddle > kAtLevel * scale;
}

/// Of two heights that are the same, which is the higher one. Scans of whole numbers are level in many places, and a
/// function that is level has no saddles to begin at, and no way up. So h counts as if it grew a little along all axes,
/// along each much more than along the one before (simulation of simplicity: Edelsbrunner and Mücke, 1990). Where nodes
/// are at the level itself only if asked: parts that touch there without any width have ways then, too.
class TieBreak {
 public:
  /// above: whether heights count as positive above the level. is_strict: of two that are the same neither is.
  TieBreak(bool above, bool is_strict) : above_(above), is_strict_(is_strict) {}

  /// a_at, b_at: grow as the places do in the order of z, y and x.
  bool is_higher(double a, int a_at, double b, int b_at) const {
    if (a != b) return a > b;
    return !is_strict_ && (above_ ? a_at > b_at : a_at < b_at);
  }
  /// Whether both heights at the ends of a face's first diagonal are greater than both at the second's.
  bool is_along_first(const std::array<double, 4>& f) const { return are_higher(f, 0, 3, 1, 2); }
  bool is_along_second(const std::array<double, 4>& f) const { return are_higher(f, 1, 2, 0, 3); }

 private:
  bool are_higher(const std::array<double, 4>& f, int a, int b, int c, int d) const {
    return is_higher(f[a], a, f[c], c) && is_higher(f[a], a, f[d], d) && is_higher(f[b], b, f[c], c) &&
           is_higher(f[b], b, f[d], d);
  }

  bool above_;
  bool is_strict_;
};

/// Grows as the neighbours of a node do in the order of z, y and x; the node itself is at 0. direction: as
/// axis_neighbor() has it.
int place_of(int direction) {
  const int axis = direction / 2 + 1;
  return direction % 2 == 0 ? -axis : axis;
}

/// The heights at the corners of a cell's low face.
std::array<double, 4> face_heights(const CellHeights& h, int axis) {
  const std::array<int, 4> corners = low_face(axis);
  return {h[corners[0]], h[corners[1]], h[corners[2]], h[corners[3]]};
}

/// An edge of the grid on a way, from the lower end.
struct Edge {
  Node from;
  Node to;
  Region region;
  auto operator<=>(const Edge&) const = default;
};

/// Collects the ways of one side of the level; heights count as positive on that side.
class WayFinder {
 public:
  WayFinder(const HeightGrid& heights, const Frame& frame, bool above, bool is_strict)
      : heights_(heights),
        frame_(frame),
        ties_(above, is_strict),
        sign_(above ? 1 : -1),
        region_(above ? 1 : kOutside) {}

  /// h: the cell's heights, saddle: one within it, both positive on the side.
  void look_at_node(const Node& n, const CellHeights& h);
  void look_at_face(const Node& cell, int axis, const CellHeights& h);
  void look_at_body(const Node& cell, const CellHeights& h, const Saddle& saddle);

  LargeVector<NarrowWay> legs;  ///< from saddles
  std::vector<Edge> edges;

 private:
  double height(const Node& n) const;
  void look_between(const Node& n, int axis, double here);
  void add_leg(const Vec& from, const Vec& to) {
    legs.push_back({region_, {frame_.to_world(from), frame_.to_world(to)}});
  }
  void add_way(const Vec& saddle, const Node& node) {
    add_leg(saddle, as_index(node));
    climb(node);
  }
  void climb(Node n);

  const HeightGrid& heights_;
  const Frame& frame_;
  TieBreak ties_;
  double sign_;
  Region region_;
};

/// Beyond the padding, lower than all.
double WayFinder::height(const Node& n) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (n[axis] < -1 || n[axis] > heights_.size()[axis]) return -std::numeric_limits<double>::max();
  }
  return sign_ * heights_.height(n[0], n[1], n[2]);
}

/// Near a node the function is as high along the axes as its neighbours make it, and in between along with them. So the
/// higher directions fall into two groups only if they are the two of one axis (a thread), and surround the node only
/// if they are the four of two axes (a sheet).
void WayFinder::look_at_node(const Node& n, const CellHeights& h) {
  if (!is_above_level(h[0], h)) return;
  const double here = h[0];
  std::array<bool, 6> higher;
  int count = 0;
  for (int d = 0; d < 6; ++d) {
    higher[d] = ties_.is_higher(height(axis_neighbor(n, d)), place_of(d), here, 0);
    count += higher[d] ? 1 : 0;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t down = 2 * static_cast<std::size_t>(axis);
    if (higher[down] != higher[down + 1] || count != (higher[down] ? 2 : 4)) continue;
    for (int d = 0; d < 6; ++d) {
      if (!higher[d]) continue;
      edges.push_back({n, axis_neighbor(n, d), region_});
      climb(axis_neighbor(n, d));
    }
    if (count == 4) look_between(n, axis, here);
    return;
  }
}

/// The ways within a sheet across `axis` from n to the middles of the four faces around it.
void WayFinder::look_between(const Node& n, int axis, double here) {
  for (int quarter = 0; quarter < 4; ++quarter) {
    const Node a = axis_neighbor(n, 2 * ((axis + 1) % 3) + (quarter & 1));
    const int across = 2 * ((axis + 2) % 3) + (quarter >> 1);
    const Node b = axis_neighbor(n, across);
    const double far = height(axis_neighbor(a, across));
    if (here + height(a) + height(b) + far > 0) add_leg(as_index(n), 0.5 * (as_index(a) + as_index(b)));
  }
}

void WayFinder::look_at_face(const Node& cell, int axis, const CellHeights& h) {
  if (cell[axis] < 0) return;
  const std::array<double, 4> f = face_heights(h, axis);
  const bool along_first = ties_.is_along_first(f);
  if (!along_first && !ties_.is_along_second(f)) return;
  const FaceSaddle saddle = face_saddle(f);
  if (!is_above_level(saddle.value, f)) return;
  const auto rises = [&](int step) {
    std::array<double, 4> there;
    for (int n = 0; n < 4; ++n) there[n] = height(low_face_node(cell, axis, n, step));
    return ties_.is_higher(saddle.at_its_place(there), step, saddle.value, 0);
  };
  const bool is_sheet = rises(1);
  if (rises(-1) != is_sheet) return;
  const Vec place = saddle.index(cell, axis);
  add_way(place, low_face_node(cell, axis, along_first ? 0 : 1, 0));
  add_way(place, low_face_node(cell, axis, along_first ? 3 : 2, 0));
  if (!is_sheet) return;
  for (const int step : {-1, 1}) {
    Vec across = place;
    across[axis] += step;
    add_leg(place, across);
  }
}

/// The Hessian has no diagonal, so its eigenvalues sum up to zero, and their product is twice that of its three
/// numbers: if it is positive, one eigenvalue is (a thread), else two are (a sheet). The single one's direction is in
/// the octants whose signs are those of the three numbers, or in a sheet opposite to them.
void WayFinder::look_at_body(const Node& cell, const CellHeights& h, const Saddle& saddle) {
  if (!is_above_level(saddle.value, h)) return;
  const auto& m = saddle.mixed;
  const bool is_thread = m[0] * m[1] * m[2] > 0;
  const double sign = is_thread ? 1 : -1;
  const int single = 1 | (sign * m[2] > 0 ? 2 : 0) | (sign * m[1] > 0 ? 4 : 0);
  for (int c = 0; c < 8; ++c) {
    const bool on_single = c == single || c == 7 - single;
    if (on_single == is_thread && lowest_on_leg(h, saddle, c) > 0) {
      add_way(as_index(cell) + saddle.position, corner_of(cell, c));
    }
  }
}

void WayFinder::climb(Node n) {
  while (true) {
    double highest = height(n);
    int best_at = 0;
    Node best = n;
    bool is_deep = true;
    for (int d = 0; d < 6; ++d) {
      const Node other = axis_neighbor(n, d);
      const double there = height(other);
      is_deep = is_deep && there > 0;
      if (ties_.is_higher(there, place_of(d), highest, best_at)) {
        highest = there;
        best_at = place_of(d);
        best = other;
      }
    }
    if (is_deep || best == n) return;
    edges.push_back({n, best, region_});
    n = best;
  }
}

/// The same saddle where heights count as positive on the side that it is on.
Saddle on_its_side(const Saddle& saddle) {
  if (saddle.value > 0) return saddle;
  return {saddle.position, -saddle.value, {-saddle.mixed[0], -saddle.mixed[1], -saddle.mixed[2]}};
}

/// Both sides of the level. Most cells have nothing for either: what a cell has is on the side that its value says.
class CellLook {
 public:
  CellLook(const HeightGrid& heights, const Frame& frame, bool is_strict)
      : sides{WayFinder(heights, frame, false, is_strict), WayFinder(heights, frame, true, is_strict)},
        heights_(heights),
        above_(true, is_strict) {}

  void look_at(int i, int j, int k) {
    const Node cell{i, j, k};
    of_side_[1] = heights_.corners(i, j, k);
    for (std::size_t n = 0; n < 8; ++n) of_side_[0][n] = -of_side_[1][n];
    const CellHeights& h = of_side_[1];
    if (std::min({i, j, k}) >= 0) {
      at_side(h[0], [&](WayFinder& side, const CellHeights& of_side) { side.look_at_node(cell, of_side); });
    }
    for (int axis = 0; axis < 3; ++axis) {
      const std::array<double, 4> f = face_heights(h, axis);
      if (!above_.is_along_first(f) && !above_.is_along_second(f)) continue;
      at_side(face_saddle(f).value,
              [&](WayFinder& side, const CellHeights& of_side) { side.look_at_face(cell, axis, of_side); });
    }
    std::array<Saddle, 2> saddles;
    const int count = body_saddles(h, saddles);
    for (int n = 0; n < count; ++n) {
      at_side(saddles[n].value, [&](WayFinder& side, const CellHeights& of_side) {
        side.look_at_body(cell, of_side, on_its_side(saddles[n]));
      });
    }
  }

  std::array<WayFinder, 2> sides;  ///< below and above the level

 private:
  template <class Look>
  void at_side(double value, const Look& look) {
    if (value == 0) return;
    const std::size_t side = value > 0 ? 1 : 0;
    look(sides[side], of_side_[side]);
  }

  const HeightGrid& heights_;
  TieBreak above_;
  std::array<CellHeights, 2> of_side_{};  // heights, positive on the side
};

bool has_nodes_at_level(const HeightGrid& heights) {
  constexpr std::size_t kLayers = 8;
  const std::array<int, 3> size = heights.size();
  std::atomic<bool> has_any{false};
  parallel_for(static_cast<std::size_t>(size[2]), kLayers, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint64_t> zeros(static_cast<std::size_t>(heights.row_words()));
    for (auto k = static_cast<int>(begin); k < static_cast<int>(end); ++k) {
      for (int j = 0; j < size[1] && !has_any; ++j) {
        if (heights.row_zeros(j, k, zeros.data())) has_any = true;
      }
    }
  });
  return has_any;
}

void sort_unique(std::vector<Edge>& edges) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

}  // namespace

void narrow_ways(const HeightGrid& heights, const Frame& frame, LevelGround ground, const NarrowWaySink& sink) {
  constexpr std::size_t kSlab = 16;  // layers of cells
  const auto layers = static_cast<std::size_t>(heights.size()[2]) + 1;
  const bool is_strict = ground == LevelGround::ends_ways && has_nodes_at_level(heights);
  std::vector<CellLook> found((layers + kSlab - 1) / kSlab, CellLook(heights, frame, is_strict));
  parallel_for(layers, kSlab, [&](std::size_t begin, std::size_t end) {
    CellLook& slab = found[begin / kSlab];
    visit_near_level(heights, 1, 2, static_cast<int>(begin) - 1, static_cast<int>(end) - 1,
                     [&](int i, int j, int k) { slab.look_at(i, j, k); });
    for (WayFinder& finder : slab.sides) sort_unique(finder.edges);
  });
  std::vector<Edge> edges;
  for (const CellLook& slab : found) {
    for (const WayFinder& finder : slab.sides) {
      for (const NarrowWay& leg : finder.legs) sink(leg);
      edges.insert(edges.end(), finder.edges.begin(), finder.edges.end());
    }
  }
  sort_unique(edges);
  for (const Edge& e : edges) {
    sink({e.region, {frame.to_world(as_index(e.from)), frame.to_world(as_index(e.to))}});
  }
}

}  // namespace scantet
