// One level set for each level, asked in turn from the outermost in; the answers are put together. Each answers
// consistently by itself. Together they do by one rule: a point is in region n if the n outermost levels, and no
// further one, have it inside. So rounding, which might put a point inside of a level but outside of the one around it,
// cannot make two answers differ: the crossings of a segment are read as events that change the states of the levels,
// and the rule turns states into regions.
#include "scantet/image/nested_level_sets.h"

#include <algorithm>
#include <cmath>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/domain/append_groups.h"
#include "scantet/domain/boundary_cells.h"
#include "scantet/topology/nested_components.h"

namespace scantet {
namespace {

constexpr double kLeastStep = 1e-6;  // of the range, between levels: far above what a crossing is off its level

/// Crossings in order, with what comes next.
struct Events {
  const Crossings& crossings;
  std::size_t next = 0;

  bool has_next() const { return next < crossings.size(); }
  const Crossing& take() { return crossings[next++]; }
  double along(const Point& origin, const Vec& direction) const {
    return dot(crossings[next].point - origin, direction);
  }
};

/// Adds to `out` the steps from region `from` to region `to`, all where a level set is crossed.
void add_steps(const Crossing& at, Region from, Region to, Crossings& out) {
  for (; from < to; ++from) out.push_back({at.point, from, from + 1, at.components});
  for (; from > to; --from) out.push_back({at.point, from, from - 1, at.components});
}

/// Merges the crossings of the levels around, at the source in region `region`, with those of the level within them,
/// whose inside is region `innermost`. inside: the source is within that level.
void merge(const Crossings& around, Region region, const Crossings& within, bool inside, Region innermost,
           const Vec& direction, Crossings& out) {
  Events outer{around};
  Events inner{within};
  const Point origin = (around.empty() ? within : around).front().point;
  const auto in_region = [&] { return inside && region == innermost - 1 ? innermost : region; };
  out.clear();
  while (outer.has_next() || inner.has_next()) {
    const Region before = in_region();
    const bool take_outer =
        !inner.has_next() || (outer.has_next() && outer.along(origin, direction) <= inner.along(origin, direction));
    const Crossing& crossing = (take_outer ? outer : inner).take();
    if (take_outer) {
      region = crossing.to;
    } else {
      inside = crossing.to != kOutside;
    }
    add_steps(crossing, before, in_region(), out);
  }
}

/// Each level's surface is one of all. The regions within a level are those above the level's number.
class NestedCells final : public BoundaryCells {
 public:
  /// levels: of which each has cells of one surface; they outlive this.
  explicit NestedCells(const std::vector<std::unique_ptr<Domain>>& levels) {
    for (const auto& level : levels) cells_.push_back(level->boundary_cells());
  }
  bool complete() const {
    return std::none_of(cells_.begin(), cells_.end(), [](const BoundaryCells* cells) { return cells == nullptr; });
  }

  std::size_t surfaces() const override { return cells_.size(); }
  std::size_t groups(std::size_t surface) const override { return cells_[surface]->groups(0); }
  void cells_of(std::size_t surface, std::size_t group, std::vector<BoundaryCell>& out) const override {
    cells_[surface]->cells_of(0, group, out);
  }
  void cells_in(std::size_t surface, const Box& box, std::vector<BoundaryCell>& out) const override {
    cells_[surface]->cells_in(0, box, out);
  }
  bool may_hold(std::size_t surface, const BoundaryCell& cell, const Vec& low, const Vec& high) const override {
    return cells_[surface]->may_hold(0, cell, low, high);
  }
  Side side_of(std::size_t surface, std::span<const Point> hull) const override {
    return cells_[surface]->side_of(0, hull);
  }

 private:
  std::vector<const BoundaryCells*> cells_;
};

class NestedLevelSets final : public Domain {
 public:
  /// Outermost first.
  explicit NestedLevelSets(std::vector<std::unique_ptr<Domain>> levels)
      : levels_(std::move(levels)), cells_(levels_), components_(nested_components(*this, levels_)) {}

  Box bounds() const override { return levels_.front()->bounds(); }

  Region region_at(const Point& p) const override { return region_within(levels_.size(), p); }

  void crossings(const Segment& segment, Crossings& out) const override {
    Crossings within;
    Crossings merged;
    out.clear();
    for (std::size_t n = 0; n < levels_.size(); ++n) {
      levels_[n]->crossings(segment, within);
      const Region at_source = within.empty() ? levels_[n]->region_at(segment.source) : within.front().from;
      if (within.empty() && at_source == kOutside) return;  // nor is any of it within the levels to come
      if (out.empty() && within.empty()) continue;
      const Region region = out.empty() ? region_within(n, segment.source) : out.front().from;
      merge(out, region, within, at_source != kOutside, static_cast<Region>(n + 1), segment.target - segment.source,
            merged);
      out.swap(merged);
    }
  }

  void surface_candidates(double spacing_mm, const PointSink& sink) const override {
    for (const auto& level : levels_) level->surface_candidates(spacing_mm, sink);
  }

  std::vector<Component> components() const override { return components_; }

  void size_hints(const SizeHintSink& sink) const override {
    for (const auto& level : levels_) level->size_hints(sink);
  }

  /// Values grow or fall all along a way, so where both ends are in one region all of it is (but for points at a
  /// level).
  void narrow_ways(LevelGround ground, const NarrowWaySink& sink) const override {
    for (const auto& level : levels_) {
      level->narrow_ways(ground, [&](const NarrowWay& way) {
        const Region region = region_at(way.segment.source);
        if (region == region_at(way.segment.target)) sink({region, way.segment});
      });
    }
  }

  std::vector<Misplaced> misplaced(const MeshBoundary& boundary, const PlaceFilter& is_asked) const override {
    std::vector<Misplaced> places;
    for (std::size_t n = 0; n < levels_.size(); ++n) {
      const auto of_level = [&](Region) { return boundary(static_cast<Region>(n + 1)); };
      std::vector<Misplaced> found = levels_[n]->misplaced(of_level, is_asked);
      for (Misplaced& place : found) place.region = region_at(place.point);
      append_groups(found, places);
    }
    return places;
  }

  Patch patch_at(const Point& p) const override {
    const std::size_t level = nearest_level(p);
    const auto within = static_cast<Region>(level + 1);
    return {{within - 1, within}, levels_[level]->patch_at(p).components};
  }

  std::optional<double> residual_at(const Point& p) const override { return levels_[nearest_level(p)]->residual_at(p); }

  const BoundaryCells* boundary_cells() const override { return cells_.complete() ? &cells_ : nullptr; }

 private:
  /// The region with the `count` outermost levels alone.
  Region region_within(std::size_t count, const Point& p) const {
    std::size_t n = 0;
    while (n < count && levels_[n]->region_at(p) != kOutside) ++n;
    return static_cast<Region>(n);
  }

  std::size_t nearest_level(const Point& p) const {
    std::size_t nearest = 0;
    double least = levels_[0]->residual_at(p).value();
    for (std::size_t n = 1; n < levels_.size(); ++n) {
      const double residual = levels_[n]->residual_at(p).value();
      if (residual >= least) break;  // they grow from there on
      least = residual;
      nearest = n;
    }
    return nearest;
  }

  std::vector<std::unique_ptr<Domain>> levels_;
  NestedCells cells_;
  std::vector<Component> components_;
};

void check_count(const std::vector<double>& levels) {
  if (!levels.empty() && levels.size() <= kMostLevels) return;
  throw Error(Fault::usage, "usage.level", std::to_string(levels.size()) + " levels are given",
              "give 1 to " + std::to_string(kMostLevels));
}

/// Outermost first.
std::vector<double> checked_levels(const NestedLevelSettings& settings, double value_range) {
  check_count(settings.levels);
  std::vector<double> levels = outermost_first(settings.levels, settings.inside);
  for (std::size_t n = 1; n < levels.size(); ++n) {
    if (std::abs(levels[n] - levels[n - 1]) >= kLeastStep * value_range) continue;
    throw Error(Fault::usage, "usage.level",
                levels[n] == levels[n - 1] ? "level " + number_text(levels[n]) + " is given twice"
                                           : "levels " + number_text(levels[n - 1]) + " and " + number_text(levels[n]) +
                                                 " are too near each other: there is no region between them",
                "leave one of them out");
  }
  return levels;
}

}  // namespace

std::vector<double> outermost_first(std::vector<double> levels, InsideSide inside) {
  std::sort(levels.begin(), levels.end(),
            [&](double a, double b) { return inside == InsideSide::above ? a < b : a > b; });
  return levels;
}

std::unique_ptr<Domain> nest_level_sets(const NestedLevelSettings& settings, double value_range,
                                        const MakeLevelSet& make) {
  std::vector<std::unique_ptr<Domain>> level_sets;
  for (const double level : checked_levels(settings, value_range)) {
    level_sets.push_back(make({level, settings.inside, settings.outside}));
    if (level_sets.back() == nullptr) return nullptr;
  }
  if (level_sets.size() == 1) return std::move(level_sets.front());
  return std::make_unique<NestedLevelSets>(std::move(level_sets));
}

NestedLevelSettings checked_settings(const Scan& scan, NestedLevelSettings settings) {
  check_count(settings.levels);
  for (const double level : settings.levels) checked_settings(scan, {level, settings.inside, settings.outside});
  // One field for all: beyond the image, too, where a level at the smallest value moves it.
  const double outermost = checked_levels(settings, scan.max_value - scan.min_value).front();
  settings.outside = checked_settings(scan, {outermost, settings.inside, settings.outside}).outside;
  return settings;
}

std::unique_ptr<Domain> make_nested_level_sets(const Scan& scan, const NestedLevelSettings& settings,
                                               const Progress& progress) {
  return nest_level_sets(checked_settings(scan, settings), scan.max_value - scan.min_value,
                         [&](const LevelSetSettings& level) { return make_level_set(scan, level, progress); });
}

}  // namespace scantet
