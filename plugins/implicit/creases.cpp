// Two parts vanish along curves. Each cell of the lattice is cut into six tets, in which the parts are taken for
// linear: a curve then passes through two of a tet's faces, and two tets agree on the face between them, so that pieces
// make chains. The lattice is moved off the places that formulas like to have their surfaces at. What is found on a
// face is moved onto both surfaces by Newton's method. Of a chain that part is an edge of the object where its being
// inside depends on the signs of both parts, and where that begins or ends a third part vanishes, too: a corner.
#include "creases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <unordered_map>

#include "crease_curve.h"
#include "scantet/base/parallel.h"

namespace implicit {
namespace {

using scantet::Point;
using scantet::Vec;

constexpr int kCells = 64;  // along each axis
constexpr int kNodes = kCells + 1;

/// The chains of points where two parts vanish.
class Chains {
 public:
  struct Chain {
    std::vector<Point> points;
    bool is_closed = false;
  };

  Chains(const std::vector<double>& a, const std::vector<double>& b) : values_{&a, &b} {}

  /// cell: (i, j, k) of its first node.
  void look_at(const std::array<int, 3>& cell) {
    static constexpr std::array<std::array<int, 2>, 6> kOrders{{{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}}};
    for (const std::array<int, 2>& order : kOrders) {
      std::array<int, 3> at = cell;
      std::array<std::uint64_t, 4> tet{index_of(at)};
      for (std::size_t n = 0; n < 3; ++n) {
        ++at[static_cast<std::size_t>(n < 2 ? order[n] : 3 - order[0] - order[1])];
        tet[n + 1] = index_of(at);
      }
      look_at(tet);
    }
  }

  /// In units of cells, from the lattice's first node.
  std::vector<Chain> take() const {
    std::vector<Chain> chains;
    std::vector<char> walked(places_.size());
    const auto walk = [&](std::uint32_t start) {
      Chain chain;
      std::uint32_t before = start;
      for (std::uint32_t at = start;;) {
        walked[at] = 1;
        chain.points.push_back(places_[at]);
        const std::array<std::uint32_t, 2>& next = links_[at];
        const std::uint32_t to = next[0] != before && next[0] != kNone && walked[next[0]] == 0 ? next[0] : next[1];
        if (to == kNone || walked[to] != 0) {
          chain.is_closed = chain.points.size() > 2 && (next[0] == start || next[1] == start);
          break;
        }
        before = at;
        at = to;
      }
      chains.push_back(std::move(chain));
    };
    for (std::uint32_t n = 0; n < places_.size(); ++n) {
      if (walked[n] == 0 && links_[n][1] == kNone) walk(n);
    }
    for (std::uint32_t n = 0; n < places_.size(); ++n) {
      if (walked[n] == 0) walk(n);
    }
    return chains;
  }

  static std::uint64_t index_of(const std::array<int, 3>& node) {
    return (static_cast<std::uint64_t>(node[2]) * kNodes + static_cast<std::uint64_t>(node[1])) * kNodes +
           static_cast<std::uint64_t>(node[0]);
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  static Point place_of(std::uint64_t node) {
    return {static_cast<double>(node % kNodes), static_cast<double>(node / kNodes % kNodes),
            static_cast<double>(node / kNodes / kNodes)};
  }

  void look_at(const std::array<std::uint64_t, 4>& tet) {
    std::array<std::uint32_t, 4> found{};
    std::size_t count = 0;
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<std::uint64_t, 3> face{};
      for (std::size_t n = 0, to = 0; n < 4; ++n) {
        if (n != left_out) face[to++] = tet[n];
      }
      if (const auto place = crossing_of(face)) found[count++] = node_of(face, *place);
    }
    if (count != 2) return;  // none, or a degenerate one
    link(found[0], found[1]);
    link(found[1], found[0]);
  }

  void link(std::uint32_t from, std::uint32_t to) {
    std::array<std::uint32_t, 2>& links = links_[from];
    (links[0] == kNone ? links[0] : links[1]) = to;
  }

  /// Nodes of a face ascend, as those of a tet do.
  std::optional<Point> crossing_of(const std::array<std::uint64_t, 3>& face) const {
    const auto f = [&](std::size_t which, std::size_t n) { return (*values_[which])[face[n]]; };
    const double a0 = f(0, 0) - f(0, 2);
    const double a1 = f(0, 1) - f(0, 2);
    const double b0 = f(1, 0) - f(1, 2);
    const double b1 = f(1, 1) - f(1, 2);
    const double determinant = a0 * b1 - a1 * b0;
    if (determinant == 0) return std::nullopt;
    const double s = (a1 * f(1, 2) - b1 * f(0, 2)) / determinant;
    const double t = (b0 * f(0, 2) - a0 * f(1, 2)) / determinant;
    if (!(s >= 0 && t >= 0 && s + t <= 1)) return std::nullopt;
    const Vec p = place_of(face[2]);
    return p + s * (place_of(face[0]) - p) + t * (place_of(face[1]) - p);
  }

  std::uint32_t node_of(const std::array<std::uint64_t, 3>& face, const Point& place) {
    constexpr unsigned kBits = 20;
    const std::uint64_t key = face[0] << 2 * kBits | face[1] << kBits | face[2];
    const auto [known, is_new] = nodes_.emplace(key, static_cast<std::uint32_t>(places_.size()));
    if (is_new) {
      places_.push_back(place);
      links_.push_back({kNone, kNone});
    }
    return known->second;
  }

  std::array<const std::vector<double>*, 2> values_;
  std::unordered_map<std::uint64_t, std::uint32_t> nodes_;  // by face
  std::vector<Point> places_;
  std::vector<std::array<std::uint32_t, 2>> links_;
};

class Finder {
 public:
  Finder(const std::string& formula, const scantet::Box& box, double degrees)
      : tree_(std::make_shared<const SignTree>(formula)), degrees_(degrees) {
    const Vec extent = box.extent();
    // A little larger than the box, and off round numbers.
    for (int axis = 0; axis < 3; ++axis) {
      cell_[axis] = extent[axis] * (1 + 0.0173 + 0.0019 * axis) / kCells;
      first_[axis] = box.min[axis] - (0.00917 + 0.00061 * axis) * extent[axis];
    }
    reach_mm_ = 2 * length(cell_);
  }

  Creases find(const scantet::Progress& progress) {
    sample(progress);
    for (std::size_t a = 0; a < tree_->parts(); ++a) {
      for (std::size_t b = a + 1; b < tree_->parts() && !progress.cancelled(); ++b) look_at(a, b);
    }
    return progress.cancelled() ? Creases() : std::move(found_);
  }

 private:
  Point place(const Vec& cells) const {
    return {first_.x + cells.x * cell_.x, first_.y + cells.y * cell_.y, first_.z + cells.z * cell_.z};
  }

  void sample(const scantet::Progress& progress) {
    constexpr std::size_t kPiece = 4096;
    constexpr std::size_t kAll = std::size_t{kNodes} * kNodes * kNodes;
    values_.assign(tree_->parts(), std::vector<double>(kAll));
    for (std::size_t part = 0; part < values_.size() && !progress.cancelled(); ++part) {
      scantet::parallel_for(kAll, kPiece, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
          values_[part][n] =
              tree_->value(part, place({static_cast<double>(n % kNodes), static_cast<double>(n / kNodes % kNodes),
                                        static_cast<double>(n / kNodes / kNodes)}));
        }
      });
    }
    mixed_.assign(std::size_t{kCells} * kCells * kCells, 0);
    for (std::size_t n = 0; n < mixed_.size(); ++n) {
      const std::array<int, 3> cell = cell_at(n);
      for (std::size_t part = 0; part < values_.size(); ++part) {
        int negative = 0;
        for (int c = 0; c < 8; ++c) {
          negative += values_[part][Chains::index_of({cell[0] + c % 2, cell[1] + c / 2 % 2, cell[2] + c / 4})] < 0;
        }
        if (negative > 0 && negative < 8) mixed_[n] |= std::uint32_t{1} << part;
      }
    }
  }

  static std::array<int, 3> cell_at(std::size_t n) {
    return {static_cast<int>(n % kCells), static_cast<int>(n / kCells % kCells), static_cast<int>(n / kCells / kCells)};
  }

  void look_at(std::size_t a, std::size_t b) {
    Chains chains(values_[a], values_[b]);
    const std::uint32_t both = std::uint32_t{1} << a | std::uint32_t{1} << b;
    for (std::size_t n = 0; n < mixed_.size(); ++n) {
      if ((mixed_[n] & both) == both) chains.look_at(cell_at(n));
    }
    for (const Chains::Chain& chain : chains.take()) add(a, b, chain);
  }

  /// A point of a chain, on both surfaces.
  struct Place {
    Point point;
    std::vector<char> negative;  ///< the signs of all parts
    bool is_edge = false;        ///< of the object
  };

  std::optional<Place> place_on(std::size_t a, std::size_t b, const Point& start) const {
    const auto point = settled(*tree_, {a, b}, start, reach_mm_);
    if (!point) return std::nullopt;
    Place found{*point, std::vector<char>(tree_->parts()), false};
    for (std::size_t part = 0; part < found.negative.size(); ++part) {
      found.negative[part] = tree_->value(part, *point) < 0;
    }
    found.is_edge = tree_->depends_on(a, b, found.negative);
    return found;
  }

  /// Between the directions that the two surfaces face.
  double degrees_at(std::size_t a, std::size_t b, const Place& place) const {
    const Vec u = tree_->side_of(a, b, place.negative) * tree_->at(a, place.point).slope;
    const Vec v = tree_->side_of(b, a, place.negative) * tree_->at(b, place.point).slope;
    return std::atan2(length(cross(u, v)), dot(u, v)) * 180 / std::numbers::pi;
  }
  bool is_sharp(std::size_t a, std::size_t b, std::span<const Place> places) const {
    return std::any_of(places.begin(), places.end(),
                       [&](const Place& place) { return degrees_at(a, b, place) >= degrees_; });
  }

  /// Cuts a chain into the pieces that are edges.
  void add(std::size_t a, std::size_t b, const Chains::Chain& chain) {
    std::vector<Place> places;
    for (const Point& start : chain.points) {
      auto found = place_on(a, b, place(start));
      const bool apart = found && (places.empty() || distance(places.back().point, found->point) > kApart * reach_mm_);
      if (found && apart) places.push_back(std::move(*found));
    }
    if (places.size() < 2) return;
    const bool whole = std::all_of(places.begin(), places.end(), [](const Place& at) { return at.is_edge; });
    if (chain.is_closed && whole) {
      if (!is_sharp(a, b, places)) return;
      std::vector<Point> points;
      points.reserve(places.size() + 1);
      for (const Place& at : places) points.push_back(at.point);
      points.push_back(points.front());
      return add_curve(a, b, std::move(points), std::nullopt);
    }
    if (chain.is_closed) {  // so that it begins off the edges
      const auto off = std::find_if(places.begin(), places.end(), [](const Place& at) { return !at.is_edge; });
      std::rotate(places.begin(), off, places.end());
      places.push_back(places.front());
    }
    for (std::size_t n = 0; n < places.size();) {
      if (!places[n].is_edge) {
        ++n;
        continue;
      }
      std::size_t end = n;
      while (end < places.size() && places[end].is_edge) ++end;
      add_piece(a, b, places, n, end);
      n = end;
    }
  }

  /// The places from begin on, before end, with a corner at either end.
  void add_piece(std::size_t a, std::size_t b, const std::vector<Place>& places, std::size_t begin, std::size_t end) {
    if (!is_sharp(a, b, std::span(places).subspan(begin, end - begin))) return;
    if (begin == 0 || end == places.size()) return;  // it leaves the box, where nothing is inside
    const auto first = corner_between(a, b, places[begin - 1], places[begin]);
    const auto last = corner_between(a, b, places[end], places[end - 1]);
    if (!first || !last) return;
    std::vector<Point> points{found_.corners[*first].point};
    const auto append = [&](const Point& p) {
      if (distance(points.back(), p) > kApart * reach_mm_) points.push_back(p);
    };
    for (std::size_t n = begin; n < end; ++n) append(places[n].point);
    const Point stop = found_.corners[*last].point;
    while (points.size() > 1 && distance(points.back(), stop) <= kApart * reach_mm_) points.pop_back();
    points.push_back(stop);
    if (points.size() == 2 && points[0] == points[1]) return;
    add_curve(a, b, std::move(points), std::array{*first, *last});
  }

  /// Where a third part changes its sign, and the chain becomes an edge; the number of the corner there.
  std::optional<std::size_t> corner_between(std::size_t a, std::size_t b, const Place& off, const Place& on) {
    std::optional<Point> best;
    for (std::size_t part = 0; part < tree_->parts(); ++part) {
      if (part == a || part == b || off.negative[part] == on.negative[part]) continue;
      std::vector<char> before = on.negative;
      before[part] = off.negative[part];
      if (tree_->depends_on(a, b, before)) continue;
      const auto p = settled(*tree_, {a, b, part}, lerp(off.point, on.point, 0.5), reach_mm_);
      if (p && (!best || distance(*p, on.point) < distance(*best, on.point))) best = p;
    }
    if (!best) return std::nullopt;
    constexpr double kSame = 1e-7;
    for (std::size_t n = 0; n < found_.corners.size(); ++n) {
      if (distance(found_.corners[n].point, *best) <= kSame * reach_mm_) return n;
    }
    found_.corners.push_back({*best, {scantet::kOutside, 1}, {}});
    return found_.corners.size() - 1;
  }

  void add_curve(std::size_t a, std::size_t b, std::vector<Point> points,
                 std::optional<std::array<std::size_t, 2>> corners) {
    scantet::PolylineCurve course(std::move(points), {1, scantet::kOutside}, corners);
    found_.curves.push_back(
        std::make_shared<CreaseCurve>(tree_, std::vector{a, b}, std::move(course), 0.5 * reach_mm_));
  }

  static constexpr double kApart = 1e-3;  // points of a course, of the reach

  std::shared_ptr<const SignTree> tree_;
  double degrees_;
  Vec cell_;
  Point first_;
  double reach_mm_ = 0;
  std::vector<std::vector<double>> values_;  // of each part at each node
  std::vector<std::uint32_t> mixed_;         // of each cell, a bit for each part of both signs at its corners
  Creases found_;
};

}  // namespace

Creases find_creases(const std::string& formula, const scantet::Box& box, double degrees,
                     const scantet::Progress& progress) {
  return Finder(formula, box, degrees).find(progress);
}

}  // namespace implicit
