// A word of regions around the piece, such as "abac", is made shorter by what an "aba" in it stands for, a line around
// b, until nothing can be taken away: then there is nothing left, or lines between three regions or more meet.
#include "scantet/cuts/rim_square.h"

#include <tuple>

namespace scantet {
namespace {

Region region_in_the_middle(const std::vector<BorderCrossing>& crossings,
                            const std::function<Region(const Point&)>& region_at) {
  Point middle;
  for (const BorderCrossing& crossing : crossings) middle = middle + crossing.point;
  return region_at((1 / static_cast<double>(crossings.size())) * middle);
}

}  // namespace

SquareLines join_crossings(std::vector<BorderCrossing> crossings,
                           const std::function<Region(const Point&)>& region_at) {
  SquareLines lines;
  while (crossings.size() >= 2) {
    const std::size_t count = crossings.size();
    const Region middle = count == 2 ? kOutside : region_in_the_middle(crossings, region_at);
    std::size_t best = count;
    std::tuple<bool, double> best_key;
    for (std::size_t i = 0; i < count; ++i) {
      const BorderCrossing& here = crossings[i];
      const BorderCrossing& next = crossings[(i + 1) % count];
      if (here.from != next.to || here.to != next.from) continue;
      const std::tuple<bool, double> key{here.to == middle, squared_distance(here.point, next.point)};
      if (best < count && best_key <= key) continue;
      best = i;
      best_key = key;
    }
    if (best == count) break;
    const std::size_t next = (best + 1) % count;
    lines.joins.push_back({crossings[best], crossings[next]});
    crossings.erase(crossings.begin() + static_cast<std::ptrdiff_t>(std::max(best, next)));
    crossings.erase(crossings.begin() + static_cast<std::ptrdiff_t>(std::min(best, next)));
  }
  if (crossings.size() >= 2) lines.junction = std::move(crossings);
  return lines;
}

}  // namespace scantet
