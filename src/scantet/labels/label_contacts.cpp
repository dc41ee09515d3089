// Runs are spread out into one layer of nodes after another, each of which is compared with the one before.
#include "scantet/labels/label_contacts.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace scantet {

std::map<Region, std::set<Region>> regions_in_contact(const RegionGrid& grid) {
  const auto row = static_cast<std::size_t>(grid.size[0]);
  const std::size_t area = row * static_cast<std::size_t>(grid.size[1]);
  std::vector<Region> below(area);
  std::vector<Region> layer(area);
  std::set<std::pair<Region, Region>> pairs;
  std::pair<Region, Region> last{};  // most pairs are the one before
  const auto meet = [&](Region a, Region b) {
    const auto pair = std::minmax(a, b);
    if (a == b || last == std::pair<Region, Region>(pair)) return;
    last = pair;
    pairs.insert(last);
  };
  std::map<Region, std::set<Region>> contacts;
  auto run = grid.runs.begin();
  for (int k = 0; k < grid.size[2]; ++k) {
    std::fill(layer.begin(), layer.end(), kOutside);
    for (; run != grid.runs.end() && run->k == k; ++run) {
      const Region region = grid.parts[run->part].region;
      contacts[region];
      const std::size_t first = static_cast<std::size_t>(run->j) * row;
      std::fill(layer.begin() + static_cast<std::ptrdiff_t>(first + static_cast<std::size_t>(run->begin)),
                layer.begin() + static_cast<std::ptrdiff_t>(first + static_cast<std::size_t>(run->end)), region);
    }
    for (std::size_t n = 0; n < area; ++n) {
      if (n % row > 0) meet(layer[n - 1], layer[n]);
      if (n >= row) meet(layer[n - row], layer[n]);
      if (k > 0) meet(below[n], layer[n]);
    }
    std::swap(below, layer);
  }
  for (const auto& [a, b] : pairs) {
    contacts[a].insert(b);
    contacts[b].insert(a);
  }
  return contacts;
}

}  // namespace scantet
