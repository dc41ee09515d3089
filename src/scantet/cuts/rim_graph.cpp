// The grid's lines are asked for all their crossings. Those on the border of a square, which the other planes may have
// cut to a smaller convex piece, say how lines run through it (rim_square.h). On the border along another plane they
// are the places of the line where the two planes meet, so that the rims in both planes end at the same corners.
#include "scantet/cuts/rim_graph.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <unordered_map>

#include "scantet/base/parallel.h"
#include "scantet/cuts/rim_square.h"

namespace scantet {
namespace {

constexpr double kMostSquares = 16e6;
constexpr double kOffset = 0.381966;  // of a square: the grid's lines should not be those of the voxels

using Square = std::uint64_t;

/// An edge of the border of a square's piece: on an edge of the square, counted from the bottom around, or on a line.
struct BorderEdge {
  Point start;
  int side;  // 0 to 3; 4 and more: on line number side - 4
};

class RimTracer {
 public:
  RimTracer(const CutSpace& space, std::size_t plane, const std::vector<CutLine>& lines)
      : space_(space), number_(plane), axes_(space.planes[plane], space.box.center()) {
    for (const CutLine& line : lines) {
      if (line.planes[0] == plane || line.planes[1] == plane) lines_.push_back(&line);
    }
  }

  RimGraph run() {
    if (!lay_grid()) return std::move(graph_);
    cross_lines(0, rows_ + 1);
    cross_lines(1, columns_ + 1);
    add_places_of_lines();
    std::sort(active_.begin(), active_.end());
    active_.erase(std::unique(active_.begin(), active_.end()), active_.end());
    for (const Square square : active_) pass_square(square);
    return std::move(graph_);
  }

 private:
  /// A crossing on an edge of the grid, in the direction of the axis.
  struct EdgeCrossing {
    std::uint32_t node;
    Region from;
    Region to;
  };

  bool lay_grid() {
    const std::vector<Point> polygon = space_.polygon(number_);
    if (polygon.empty()) return false;
    Box box;
    for (const Point& p : polygon) box.extend({axes_.u_of(p), axes_.v_of(p), 0});
    double step = space_.step_mm;
    const auto squares = [&](double length) { return length / step + 2; };
    const auto all = [&] { return squares(box.extent().x) * squares(box.extent().y); };
    while (all() > kMostSquares) step *= 1.25;
    graph_.step_mm = step;
    u0_ = box.min.x - kOffset * step;
    v0_ = box.min.y - kOffset * step;
    columns_ = graph_.columns = static_cast<std::uint64_t>(squares(box.extent().x));
    rows_ = static_cast<std::uint64_t>(squares(box.extent().y));
    return true;
  }

  Point corner_of(std::uint64_t i, std::uint64_t j) const {
    return axes_.at(u0_ + static_cast<double>(i) * graph_.step_mm, v0_ + static_cast<double>(j) * graph_.step_mm);
  }

  static std::uint64_t place_in(double mm, double step_mm, std::uint64_t count) {
    const double n = std::floor(mm / step_mm);
    return n <= 0 ? 0 : std::min(static_cast<std::uint64_t>(n), count - 1);
  }
  std::uint64_t column_of(const Point& p) const { return place_in(axes_.u_of(p) - u0_, graph_.step_mm, columns_); }
  std::uint64_t row_of(const Point& p) const { return place_in(axes_.v_of(p) - v0_, graph_.step_mm, rows_); }

  /// direction: 0: edges along u, 1: along v; from corner (i, j) on.
  std::uint64_t edge(int direction, std::uint64_t i, std::uint64_t j) const {
    return 2 * (j * (columns_ + 1) + i) + static_cast<std::uint64_t>(direction);
  }

  void activate(std::uint64_t i, std::uint64_t j) {
    if (i < columns_ && j < rows_) active_.push_back(j * columns_ + i);
  }

  /// Asks all lines of a direction, side by side, and sorts their crossings into the edges.
  void cross_lines(int direction, std::uint64_t count) {
    struct Found {
      Crossings crossings;
      bool meets_inside = false;
    };
    std::vector<Found> found(count);
    parallel_for(count, 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        const Segment line = direction == 0 ? Segment{corner_of(0, n), corner_of(columns_, n)}
                                            : Segment{corner_of(n, 0), corner_of(n, rows_)};
        const auto stretch = space_.kept(line, {number_, kNoPlane});
        if (!stretch) continue;
        const Segment kept{lerp(line.source, line.target, stretch->enter),
                           lerp(line.source, line.target, stretch->leave)};
        space_.inner.crossings(kept, found[n].crossings);
        found[n].meets_inside =
            !found[n].crossings.empty() || space_.inner.region_at(lerp(kept.source, kept.target, 0.5)) != kOutside;
      }
    });
    for (std::size_t n = 0; n < count; ++n) {
      graph_.meets_inside = graph_.meets_inside || found[n].meets_inside;
      for (const Crossing& crossing : found[n].crossings) add_crossing(direction, n, crossing);
    }
  }

  void add_crossing(int direction, std::uint64_t line, const Crossing& crossing) {
    const Point p = axes_.plane().nearest(crossing.point);
    const std::uint64_t i = direction == 0 ? column_of(p) : line;
    const std::uint64_t j = direction == 0 ? line : row_of(p);
    assert(i <= columns_ && j <= rows_ && crossing.from != crossing.to);
    edges_[edge(direction, i, j)].push_back({add_node({p, std::nullopt, false}), crossing.from, crossing.to});
    activate(i, j);
    if (direction == 0 && j > 0) activate(i, j - 1);
    if (direction == 1 && i > 0) activate(i - 1, j);
  }

  std::uint32_t add_node(const RimNode& node) {
    graph_.nodes.push_back(node);
    return static_cast<std::uint32_t>(graph_.nodes.size() - 1);
  }

  void add_places_of_lines() {
    for (const CutLine* line : lines_) {
      first_node_.push_back(static_cast<std::uint32_t>(graph_.nodes.size()));
      for (const CutLine::Place& place : line->places) {
        add_node({place.point, place.corner, false});
        const std::uint64_t i = column_of(place.point);
        const std::uint64_t j = row_of(place.point);
        for (const std::uint64_t di : {0, 1, 2}) {
          for (const std::uint64_t dj : {0, 1, 2}) activate(i + di - 1, j + dj - 1);  // beyond 0 it is too large
        }
      }
    }
  }

  void pass_square(Square square) {
    const std::uint64_t i = square % columns_;
    const std::uint64_t j = square / columns_;
    std::vector<BorderEdge> border{
        {corner_of(i, j), 0}, {corner_of(i + 1, j), 1}, {corner_of(i + 1, j + 1), 2}, {corner_of(i, j + 1), 3}};
    for (std::size_t l = 0; l < lines_.size(); ++l) clip(border, l);
    std::vector<BorderCrossing> around;
    for (std::size_t n = 0; n < border.size(); ++n) {
      if (border[n].side < 4) {
        add_of_side(i, j, border[n].side, around);
      } else {
        add_of_line(static_cast<std::size_t>(border[n].side) - 4, border[n].start,
                    border[(n + 1) % border.size()].start, around);
      }
    }
    if (!around.empty()) link(square, std::move(around));
  }

  /// Cuts off what is beyond the plane that line l is in beside this one.
  void clip(std::vector<BorderEdge>& border, std::size_t l) const {
    const auto& both = lines_[l]->planes;
    const CutPlane& plane = space_.planes[both[0] == number_ ? both[1] : both[0]];
    std::vector<BorderEdge> left;
    for (std::size_t n = 0; n < border.size(); ++n) {
      const Point& a = border[n].start;
      const Point& b = border[(n + 1) % border.size()].start;
      const bool keeps_a = plane.beyond_mm(a) < 0;
      const bool keeps_b = plane.beyond_mm(b) < 0;
      if (keeps_a) left.push_back(border[n]);
      if (keeps_a == keeps_b) continue;
      // The same bits from both squares at the edge.
      const auto& [low, high] = std::minmax(a, b, lexicographically_less);
      const double over_low = plane.beyond_mm(low);
      const Point cut = lerp(low, high, over_low / (over_low - plane.beyond_mm(high)));
      left.push_back({cut, keeps_a ? static_cast<int>(l) + 4 : border[n].side});
    }
    border = std::move(left);
  }

  void add_of_side(std::uint64_t i, std::uint64_t j, int side, std::vector<BorderCrossing>& around) const {
    const std::uint64_t key = side == 0   ? edge(0, i, j)
                              : side == 1 ? edge(1, i + 1, j)
                              : side == 2 ? edge(0, i, j + 1)
                                          : edge(1, i, j);
    const auto found = edges_.find(key);
    if (found == edges_.end()) return;
    const std::vector<EdgeCrossing>& on_edge = found->second;
    const auto point = [&](std::uint32_t node) { return graph_.nodes[node].point; };
    if (side < 2) {
      for (const EdgeCrossing& c : on_edge) around.push_back({c.node, point(c.node), c.from, c.to});
    } else {
      for (auto c = on_edge.rbegin(); c != on_edge.rend(); ++c) {
        around.push_back({c->node, point(c->node), c->to, c->from});
      }
    }
  }

  void add_of_line(std::size_t l, const Point& start, const Point& end, std::vector<BorderCrossing>& around) const {
    const CutLine& line = *lines_[l];
    const double from = line.along_mm(start);
    const double to = line.along_mm(end);
    std::vector<BorderCrossing> found;
    for (std::size_t n = 0; n < line.places.size(); ++n) {
      const CutLine::Place& place = line.places[n];
      if (place.along_mm < std::min(from, to) || place.along_mm >= std::max(from, to)) continue;
      found.push_back({first_node_[l] + static_cast<std::uint32_t>(n), place.point, place.from, place.to});
    }
    if (from > to) {
      std::reverse(found.begin(), found.end());
      for (BorderCrossing& crossing : found) std::swap(crossing.from, crossing.to);
    }
    around.insert(around.end(), found.begin(), found.end());
  }

  void link(Square square, std::vector<BorderCrossing> around) {
    const SquareLines lines =
        join_crossings(std::move(around), [&](const Point& p) { return space_.inner.region_at(p); });
    for (const auto& [start, end] : lines.joins) {
      graph_.links.push_back({{start.node, end.node}, start.from, start.to, square});
    }
    if (lines.junction.empty()) return;
    Point middle;
    for (const BorderCrossing& crossing : lines.junction) middle = middle + crossing.point;
    middle = (1 / static_cast<double>(lines.junction.size())) * middle;
    const std::uint32_t node = add_node({axes_.plane().nearest(middle), std::nullopt, true});
    for (const BorderCrossing& crossing : lines.junction) {
      graph_.links.push_back({{crossing.node, node}, crossing.from, crossing.to, square});
    }
  }

  const CutSpace& space_;
  std::size_t number_;
  PlaneAxes axes_;
  std::vector<const CutLine*> lines_;      // in the plane
  std::vector<std::uint32_t> first_node_;  // of the places of each line
  double u0_ = 0;
  double v0_ = 0;
  std::uint64_t columns_ = 0;
  std::uint64_t rows_ = 0;
  std::unordered_map<std::uint64_t, std::vector<EdgeCrossing>> edges_;
  std::vector<Square> active_;  // that a line may pass through
  RimGraph graph_;
};

}  // namespace

RimGraph trace_rims(const CutSpace& space, std::size_t plane, const std::vector<CutLine>& lines) {
  return RimTracer(space, plane, lines).run();
}

}  // namespace scantet
