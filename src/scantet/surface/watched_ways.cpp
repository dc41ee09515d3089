// A slot of the triangulation gets another generation when its tet is replaced, so a way whose tets all have theirs
// still needs no look.
#include <algorithm>
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/surface/along_curve_impl.h"
#include "scantet/surface/watched_ways_impl.h"
#include "scantet/surface/way_walk_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kWaysOfTrace = 2048;

/// The domain's narrow ways, along a curve.
LargeVector<NarrowWay> ways_along_curve(const Domain& domain, LevelGround ground) {
  constexpr std::size_t kGrain = 4096;
  constexpr std::size_t kMany = std::size_t{1} << 20;
  LargeVector<NarrowWay> ways;
  ways.reserve(kMany);  // memory that is not written costs nothing; growing does
  domain.narrow_ways(ground, [&](const NarrowWay& way) { ways.push_back(way); });
  const auto source = [](const NarrowWay& way) -> const Point& { return way.segment.source; };
  const std::vector<std::uint32_t> order = along_curve(ways, domain.bounds(), source);
  LargeVector<NarrowWay> sorted;
  sorted.resize(ways.size());
  parallel_for(sorted.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) sorted[n] = ways[order[n]];
  });
  return sorted;
}

}  // namespace

LargeVector<NarrowWay> agreed_ways(const Domain& domain, LevelGround ground) {
  constexpr std::size_t kGrain = 1024;
  LargeVector<NarrowWay> ways = ways_along_curve(domain, ground);
  std::vector<std::uint8_t> agrees(ways.size());
  parallel_for(ways.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Segment> segments;
    std::vector<Point> sources;
    for (std::size_t i = begin; i < end; ++i) {
      segments.push_back(ways[i].segment);
      sources.push_back(ways[i].segment.source);
    }
    CrossingLists crossings;
    domain.crossings_of(segments, crossings);
    std::vector<Region> regions(sources.size());
    domain.regions_at(sources, regions);
    for (std::size_t i = begin; i < end; ++i) {
      agrees[i] = crossings[i - begin].empty() && regions[i - begin] == ways[i].region ? 1 : 0;
    }
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (agrees[i] != 0) ways[kept++] = ways[i];
  }
  ways.resize(kept);
  return ways;
}

CellId any_cell(const Triangulation& t) {
  CellId cell = 0;
  while (!t.is_cell(cell)) ++cell;
  return cell;
}

std::vector<WrongTet> WatchedWays::wrong(std::span<const NarrowWay> ways) {
  traces_.resize((ways.size() + kWaysOfTrace - 1) / kWaysOfTrace);
  const CellId start = any_cell(t_);
  std::vector<WrongTet> wrong =
      parallel_collect<WrongTet>(ways.size(), kWaysOfTrace, [&](std::size_t begin, std::size_t end, auto& found) {
        follow(ways.subspan(begin, end - begin), start, traces_[begin / kWaysOfTrace], found);
      });
  std::stable_sort(wrong.begin(), wrong.end(), [](const WrongTet& a, const WrongTet& b) { return a.cell < b.cell; });
  const auto is_same = [](const WrongTet& a, const WrongTet& b) { return a.cell == b.cell; };
  wrong.erase(std::unique(wrong.begin(), wrong.end(), is_same), wrong.end());
  return wrong;
}

/// trace: as the look before has left it, or empty.
void WatchedWays::follow(std::span<const NarrowWay> ways, CellId start, Trace& trace,
                         std::vector<WrongTet>& wrong) const {
  const Trace before = std::exchange(trace, {});
  WayWalk walk(t_, start);
  std::size_t begin = 0;
  for (std::size_t n = 0; n < ways.size(); ++n) {
    const std::size_t end = before.ends.empty() ? begin : before.ends[n];
    const std::span<const SeenCell> known(before.cells.data() + begin, end - begin);
    begin = end;
    const bool are_right = !known.empty() && std::all_of(known.begin(), known.end(), [&](const SeenCell& seen) {
      return is_right(seen, ways[n].region);
    });
    if (are_right) {
      trace.cells.insert(trace.cells.end(), known.begin(), known.end());
      walk.go_to(known.back().cell);
    } else {
      walk.run(ways[n].segment, [&](CellId cell, const Point& place) {
        trace.cells.push_back({cell, t_.info(cell).generation});
        if (t_.info(cell).region != ways[n].region) wrong.push_back({cell, place});
      });
    }
    trace.ends.push_back(static_cast<std::uint32_t>(trace.cells.size()));
  }
}

}  // namespace scantet::engine
