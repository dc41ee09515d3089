// The queries, and the topology that specks are told by, are those of a scan: the grid is handed over as one.
#include "level_grid.h"

#include <algorithm>
#include <cmath>

#include "scantet/image/level_set.h"

namespace points {
namespace {

using Node = std::array<int, 3>;

Node node_near(const LevelGrid& grid, const scantet::Point& p) {
  Node node;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = std::round((p[axis] - grid.origin[axis]) / grid.step_mm);
    node[axis] = static_cast<int>(std::clamp(at, 0.0, grid.size[axis] - 1.0));
  }
  return node;
}

/// Turns the sign of the witness and of all of its sign that hang together with it in the component's box, corner to
/// corner counted: that is the component, and seldom more.
void turn(const scantet::Component& component, float least, LevelGrid& grid) {
  const Node low = node_near(grid, component.box_mm.min);
  const Node high = node_near(grid, component.box_mm.max);
  const bool inside = component.region != scantet::kOutside;
  std::vector<Node> open{node_near(grid, component.witness)};
  while (!open.empty()) {
    const Node node = open.back();
    open.pop_back();
    float& value = (*grid.values)[grid.index(node[0], node[1], node[2])];
    if ((value < 0) != inside) continue;
    value = std::copysign(std::max(std::abs(value), least), inside ? 1.0F : -1.0F);
    for (int k = std::max(low[2], node[2] - 1); k <= std::min(high[2], node[2] + 1); ++k) {
      for (int j = std::max(low[1], node[1] - 1); j <= std::min(high[1], node[1] + 1); ++j) {
        for (int i = std::max(low[0], node[0] - 1); i <= std::min(high[0], node[0] + 1); ++i) open.push_back({i, j, k});
      }
    }
  }
}

}  // namespace

bool reaches_border(const LevelGrid& grid) {
  const auto row_is_on_it = [&](int j, int k) {
    return j == 0 || k == 0 || j == grid.size[1] - 1 || k == grid.size[2] - 1;
  };
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      const auto row = grid.values->begin() + static_cast<std::ptrdiff_t>(grid.index(0, j, k));
      const auto end = row + grid.size[0];
      if (*row < 0 || end[-1] < 0) return true;
      if (row_is_on_it(j, k) && std::any_of(row, end, [](float value) { return value < 0; })) return true;
    }
  }
  return false;
}

std::unique_ptr<scantet::Domain> make_domain(const LevelGrid& grid) {
  scantet::Scan scan;
  scan.size = grid.size;
  scan.frame = grid.frame();
  scan.voxels = static_cast<const float*>(grid.values->data());
  scan.owner = grid.values;
  const auto [lowest, highest] = std::minmax_element(grid.values->begin(), grid.values->end());
  scan.min_value = *lowest;
  scan.max_value = *highest;
  scantet::LevelSetSettings settings;
  settings.inside = scantet::InsideSide::below;
  return scantet::make_level_set(scan, settings);
}

std::size_t drop_specks(const scantet::Domain& domain, double volume_mm3, LevelGrid& grid) {
  constexpr double kLeast = 1e-6;  // of the range of values: a node exactly at zero must change, too
  const auto [lowest, highest] = std::minmax_element(grid.values->begin(), grid.values->end());
  const float least = static_cast<float>(kLeast * (double{*highest} - *lowest));
  std::size_t specks = 0;
  const std::vector<scantet::Component> components = domain.components();
  for (const scantet::Component& component : components) {
    const bool is_largest = &component == &components.front();
    if (is_largest || component.volume_mm3 >= volume_mm3) continue;
    turn(component, least, grid);
    ++specks;
  }
  return specks;
}

}  // namespace points
