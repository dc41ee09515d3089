#include "scantet/verify/distances.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "scantet/base/parallel.h"
#include "scantet/verify/cell_boxes.h"

namespace scantet::verify {
double squared_distance_to(const Point& p, const Point& a, const Point& b, const Point& c) {
  const auto to_segment = [&](const Point& u, const Point& v) {
    const double span = squared_distance(u, v);
    const double t = span > 0 ? std::clamp(dot(p - u, v - u) / span, 0.0, 1.0) : 0;
    return squared_distance(p, lerp(u, v, t));
  };
  double best = std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
  const Vec n = cross(b - a, c - a);
  const double nn = squared_length(n);
  if (nn > 0) {
    const double u = dot(cross(b - a, p - a), n) / nn;
    const double v = dot(cross(p - a, c - a), n) / nn;
    if (u >= 0 && v >= 0 && u + v <= 1) best = std::min(best, squared_distance(p, a + v * (b - a) + u * (c - a)));
  }
  return best;
}

std::optional<Interval> field_at(const CollarInput& in, const IntervalVec& place) {
  const VoxelNodes& nodes = in.nodes;
  Box box;
  extend(box, place);
  Cell first;
  Cell last;
  if (!cells_of(nodes, box, first, last)) return std::nullopt;
  std::optional<Interval> all;
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        const Cell cell{i, j, k};
        Interval range = value_range(nodes.cell(cell), cell, within(box, cell));
        if (in.sides.any() && in.sides.has_left_out(cell)) {
          const int side = in.sides.side_of(cell);
          if (side == 0) return std::nullopt;
          range = Interval(side);
        }
        all = all ? hull(*all, range) : range;
      }
    }
  }
  return all;
}

bool is_near_level(const CollarInput& in, const Collar& collar, std::uint32_t v, double tolerance_mm) {
  const IntervalVec along(collar.directions[v]);
  const Interval step(0.999 * tolerance_mm);
  if (length_bound(in.map.to_world(step * along)) > tolerance_mm) return false;
  const auto inner = field_at(in, in.places[v] + step * along);
  const auto outer = field_at(in, in.places[v] - step * along);
  return inner && outer && inner->is_positive() && outer->is_negative();
}

Distances::Distances(const CollarInput& input, const Collar& collar, const BoxTree& facets)
    : in_(input), collar_(collar), tree_(facets) {
  double largest = 0;
  for (const VertexId v : in_.shell.vertices) largest = std::max(largest, length(in_.mesh.vertices[v]));
  const Frame& frame = in_.nodes.frame();
  const auto& size = in_.nodes.size();
  const Box image = frame.world_box({-1, -1, -1}, {double(size[0]), double(size[1]), double(size[2])});
  largest = std::max({largest, length(image.min), length(image.max)});
  margin_mm_ = 1e-13 * largest;
  double worst = 0;
  for (int axis = 0; axis < 3; ++axis) {
    spacing_[static_cast<std::size_t>(axis)] = frame.spacing_mm(axis) * (1 - 1e-12);
    double sum = 0;
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      sum +=
          std::abs(dot(frame.column(axis), frame.column(other))) / (frame.spacing_mm(axis) * frame.spacing_mm(other));
    }
    worst = std::max(worst, sum);
  }
  skew_ = std::max(0.0, 1 - worst - 1e-12);  // Gershgorin's bound of the smallest eigenvalue
  for (int turn = 0; turn < 4; ++turn) {
    const Vec diagonal{0.5, turn & 1 ? -0.5 : 0.5, turn & 2 ? -0.5 : 0.5};
    cell_radius_mm_ = std::max(cell_radius_mm_, length_bound(in_.map.to_world(IntervalVec(diagonal))));
  }
}

std::optional<double> Distances::bound_at(const Vec& place, const Vec& along, double limit) const {
  const auto here = field_at(in_, IntervalVec(place));
  if (!here) return std::nullopt;
  if (!here->is_positive() && !here->is_negative()) return bound_on_level(place, along);
  const double way = here->is_positive() ? -1 : 1;
  double low = 0;
  for (int step = 1; step <= 24; ++step) {
    const double to = limit * step * step / 576;
    const bool has_changed = (sampled_value(in_.nodes, place + way * to * along) > 0) != here->is_positive();
    if (!has_changed) {
      low = to;
      continue;
    }
    double high = to;
    for (int halving = 0; halving < 6; ++halving) {
      const double middle = 0.5 * (low + high);
      ((sampled_value(in_.nodes, place + way * middle * along) > 0) != here->is_positive() ? high : low) = middle;
    }
    high *= 1.001;
    const IntervalVec reach = Interval(way * high) * IntervalVec(along);
    const auto there = field_at(in_, IntervalVec(place) + reach);
    if (there && (here->is_positive() ? there->is_negative() : there->is_positive())) {
      return length_bound(in_.map.to_world(reach));
    }
    low = to;
  }
  return std::nullopt;
}

std::optional<double> Distances::bound_on_level(const Vec& place, const Vec& along) const {
  for (double step = 1e-6; step < 2; step *= 10) {
    const IntervalVec reach = Interval(step) * IntervalVec(along);
    const auto inner = field_at(in_, IntervalVec(place) + reach);
    const auto outer = field_at(in_, IntervalVec(place) - reach);
    if (!inner || !outer) return std::nullopt;
    const bool differ =
        (inner->is_positive() && outer->is_negative()) || (inner->is_negative() && outer->is_positive());
    if (differ) return length_bound(in_.map.to_world(reach));
  }
  return std::nullopt;
}

std::optional<double> Distances::bound_by_node(const Vec& place) const {
  const auto here = field_at(in_, IntervalVec(place));
  if (!here || (!here->is_positive() && !here->is_negative())) return std::nullopt;
  const int wanted = here->is_positive() ? -1 : 1;
  std::optional<double> best;
  constexpr int kReach = 4;
  Cell base;
  for (int axis = 0; axis < 3; ++axis) base[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(place[axis]));
  for (int n = 0; n < 8 * kReach * kReach * kReach; ++n) {
    const Cell node{base[0] + n % (2 * kReach) - kReach + 1, base[1] + n / (2 * kReach) % (2 * kReach) - kReach + 1,
                    base[2] + n / (4 * kReach * kReach) - kReach + 1};
    bool is_within = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      is_within = is_within && node[axis] >= -1 && node[axis] <= in_.nodes.size()[axis];
    }
    if (!is_within || in_.nodes.sign(node[0], node[1], node[2]) != wanted || in_.sides.is_left_out(node)) continue;
    const IntervalVec way = IntervalVec(Vec{double(node[0]), double(node[1]), double(node[2])}) - IntervalVec(place);
    best = std::min(best.value_or(HUGE_VAL), length_bound(in_.map.to_world(way)));
  }
  return best;
}

std::optional<double> Distances::bound_of_facet(std::size_t f) const {
  const Triangle& t = in_.shell.facets[f];
  constexpr int kParts = 4;  // of each side
  double worst = 0;
  const double reach = std::max(4 * in_.nodes.frame().min_spacing_mm(), 3 * collar_.sampled_mm[f]);
  double radius = 0;  // of a part: no point of it is farther from its centre
  for (std::size_t n = 0; n < 3; ++n) {
    const IntervalVec side = in_.places[t[(n + 1) % 3]] - in_.places[t[n]];
    radius = std::max(radius, length_bound(in_.map.to_world(side)) / kParts * (2.0 / 3 + 1e-9));
  }
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; i + j < kParts; ++j) {
      for (int turned = 0; turned < 2 && i + j + turned < kParts; ++turned) {
        const double u = (i + (turned + 1) / 3.0) / kParts;
        const double v = (j + (turned + 1) / 3.0) / kParts;
        const std::array<double, 3> weight{1 - u - v, u, v};
        Vec place;
        Vec along;
        for (std::size_t n = 0; n < 3; ++n) {
          place = place + weight[n] * in_.places[t[n]].middle();
          along = along + weight[n] * collar_.directions[t[n]];
        }
        std::optional<double> best = bound_at(place, along, reach);
        const auto take = [&](const std::optional<double>& bound) {
          if (bound) best = std::min(best.value_or(HUGE_VAL), *bound);
        };
        for (int axis = 0; axis < 6; ++axis) {
          Vec step;
          step[axis % 3] = (axis < 3 ? 1 : -1) / in_.nodes.frame().spacing_mm(axis % 3);
          take(bound_at(place, step, best.value_or(reach)));
        }
        if (!best) take(bound_by_node(place));
        if (!best) return std::nullopt;
        worst = std::max(worst, *best + radius);
      }
    }
  }
  return worst + margin_mm_;
}

double Distances::distance_to_boundary(const Point& p, double enough) const {
  const auto corner = [&](std::uint32_t f, std::size_t n) {
    return in_.mesh.vertices[in_.shell.vertices[in_.shell.facets[f][n]]];
  };
  return std::sqrt(tree_.nearest2(p, enough * enough, [&](std::uint32_t f) {
    return squared_distance_to(p, corner(f, 0), corner(f, 1), corner(f, 2));
  }));
}

constexpr int kHalvings = 4;  // of cells that may hold the level set

double Distances::level_in_box(const CellValues& values, const Cell& cell, const Box& box, double aim, int depth,
                               Point& place) const {
  if (!may_hold_level(value_range(values, cell, box))) return 0;
  const Point center = in_.nodes.frame().to_world(box.center());
  const double radius = std::ldexp(cell_radius_mm_, depth - kHalvings);
  const double bound = distance_to_boundary(center, std::max(0.0, aim - radius - margin_mm_)) + radius + margin_mm_;
  if (bound <= aim || depth == 0) {
    place = center;
    return bound;
  }
  double worst = 0;
  for (int n = 0; n < 8; ++n) {
    Point there;
    const double part = level_in_box(values, cell, eighth(box, n), std::max(aim, worst), depth - 1, there);
    if (part <= worst) continue;
    worst = part;
    place = there;
  }
  return worst;
}

double Distances::bound_of_level(double aim, const Progress& progress, Point& place) const {
  const auto layers = static_cast<std::size_t>(in_.nodes.size()[2]) + 1;
  std::vector<double> worst(layers, 0);
  std::vector<Point> places(layers);
  parallel_for(layers, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      if (progress.cancelled()) return;
      for_cells_of_layer(in_.nodes, static_cast<int>(k) - 1, [&](const Cell& cell, int low, int high) {
        if (low == high && low != 0) return;
        if (in_.sides.any() && in_.sides.side_of(cell) != 0) return;  // what is there was left out
        Point there;
        const double bound =
            level_in_box(in_.nodes.cell(cell), cell, whole_cell(cell), std::max(aim, worst[k]), kHalvings, there);
        if (bound <= worst[k]) return;
        worst[k] = bound;
        places[k] = there;
      });
    }
  });
  const auto at = std::max_element(worst.begin(), worst.end());
  place = places[static_cast<std::size_t>(at - worst.begin())];
  return *at;
}

Distances::Sample Distances::farthest_sample(std::size_t f) const {
  const Triangle& t = in_.shell.facets[f];
  Sample best;
  for (int i = 0; i <= 6; ++i) {
    for (int j = 0; i + j <= 6; ++j) {
      const std::array<double, 3> weight{1 - (i + j) / 6.0, i / 6.0, j / 6.0};
      Sample sample;
      for (std::size_t n = 0; n < 3; ++n) {
        sample.place = sample.place + weight[n] * in_.places[t[n]].middle();
        sample.along = sample.along + weight[n] * collar_.directions[t[n]];
      }
      const bool is_inside = sampled_value(in_.nodes, sample.place) > 0;
      double low = 0;
      double high = std::max(1.5 * collar_.sampled_mm[f], 1e-6);
      for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (low + high);
        const Vec there = sample.place + (is_inside ? -middle : middle) * sample.along;
        ((sampled_value(in_.nodes, there) > 0) == is_inside ? low : high) = middle;
      }
      sample.off = is_inside ? -low : low;
      if (std::abs(sample.off) > std::abs(best.off) || i + j == 0) best = sample;
    }
  }
  return best;
}

double Distances::at_least(std::size_t f, Point& place) const {
  const Sample sample = farthest_sample(f);
  place = in_.nodes.frame().to_world(sample.place);
  return free_radius(IntervalVec(sample.place), 1.2 * std::abs(sample.off));
}

double Distances::level_at_least(std::size_t f, Point& place) const {
  const Sample sample = farthest_sample(f);
  const double step = std::max(1e-7, 1e-4 * std::abs(sample.off));
  const auto inner = field_at(in_, IntervalVec(sample.place + (sample.off + step) * sample.along));
  const auto outer = field_at(in_, IntervalVec(sample.place + (sample.off - step) * sample.along));
  if (!inner || !outer || !inner->is_positive() || !outer->is_negative()) return 0;
  place = in_.nodes.frame().to_world(sample.place + sample.off * sample.along);
  return std::max(0.0, distance_to_boundary(place, 0) - 1.1 * step - margin_mm_);
}

double Distances::free_radius(const IntervalVec& place, double limit) const {
  struct Open {
    double gap;
    Cell cell;
    Box box;
    bool operator<(const Open& other) const { return gap > other.gap; }
  };
  const auto gap = [&](const Box& box) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = std::max({0.0, box.min[axis] - place[axis].hi, place[axis].lo - box.max[axis]});
      sum += d * d * spacing_[static_cast<std::size_t>(axis)] * spacing_[static_cast<std::size_t>(axis)];
    }
    return std::sqrt(skew_ * sum) * (1 - 1e-12);
  };
  std::priority_queue<Open> open;
  const Vec p = place.middle();
  const auto add = [&](const Cell& cell, const Box& box) {
    const double d = gap(box);
    if (d < limit && may_hold_level(value_range(in_.nodes.cell(cell), cell, box))) open.push({d, cell, box});
  };
  Cell from;
  Cell to;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    const double reach = limit / (spacing_[axis] * std::sqrt(std::max(skew_, 1e-6))) + 1;
    if (!(reach < 200)) return 0;
    from[axis] = std::max(-1, static_cast<int>(std::floor(p[a] - reach)));
    to[axis] = std::min(in_.nodes.size()[axis] - 1, static_cast<int>(std::floor(p[a] + reach)));
  }
  for (int k = from[2]; k <= to[2]; ++k) {
    for (int j = from[1]; j <= to[1]; ++j) {
      for (int i = from[0]; i <= to[0]; ++i) add({i, j, k}, whole_cell({i, j, k}));
    }
  }
  for (int steps = 0; !open.empty(); ++steps) {
    const Open next = open.top();
    if (steps == 4000 || next.box.extent().x < 1e-4) return std::min(limit, next.gap);
    open.pop();
    for (int n = 0; n < 8; ++n) add(next.cell, eighth(next.box, n));
  }
  return limit;
}

}  // namespace scantet::verify
