// A region reaches less than a step of the grid beyond its nodes, along each axis.
#include "scantet/cuts/cut_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace scantet {
namespace {

constexpr double kRounding = 1e-9;  // of the reach

/// How far beyond a plane something can be that is less than a step from a node on it, mm.
double reach_mm(const CutPlane& plane, const Frame& frame) {
  double reach = 0;
  for (int axis = 0; axis < 3; ++axis) reach += std::abs(dot(plane.normal, frame.column(axis)));
  return reach;
}

class GridCutter {
 public:
  GridCutter(const RegionGrid& grid, const std::vector<CutPlane>& planes) : grid_(grid), planes_(planes) {
    for (const CutPlane& plane : planes) reach_mm_.push_back(reach_mm(plane, grid.frame));
  }

  RegionGrid cut() {
    RegionGrid cut{grid_.frame, grid_.size, {}, {}, {}, false};
    for (const GridRun& run : grid_.runs) {
      for (int i = run.begin; i < run.end; ++i) {
        if (!is_left(run, i)) continue;
        const int begin = i;
        while (i + 1 < run.end && is_left(run, i + 1)) ++i;
        put({run.j, run.k, begin, i + 1, run.part}, cut);
      }
    }
    for (const GridRegion& region : grid_.regions) {
      const auto left = left_.find(region.region);
      if (left == left_.end()) continue;
      const bool is_whole = touched_.count(region.region) == 0;
      cut.regions.push_back(
          {region.region, left->second, is_whole ? region.volume_mm3 : std::numeric_limits<double>::quiet_NaN()});
    }
    cut.is_cut = grid_.is_cut ||
                 std::any_of(planes_.begin(), planes_.end(), [](const CutPlane& plane) { return !plane.is_border(); });
    return cut;
  }

 private:
  /// Notes whether a plane comes near.
  bool is_left(const GridRun& run, int i) {
    const Point p = grid_.frame.to_world({double(i), double(run.j), double(run.k)});
    bool is_left = true;
    for (std::size_t n = 0; n < planes_.size(); ++n) {
      const double beyond = planes_[n].beyond_mm(p);
      is_left = is_left && (planes_[n].is_border() || beyond < 0);
      if (beyond > -reach_mm_[n] * (1 - kRounding)) touched_.insert(grid_.parts[run.part].region);
    }
    return is_left;
  }

  void put(GridRun run, RegionGrid& cut) {
    const GridPart& part = grid_.parts[run.part];
    const auto [known, is_new] = number_of_.emplace(run.part, static_cast<std::uint32_t>(cut.parts.size()));
    if (is_new) cut.parts.push_back({part.region, 0, {run.begin, run.j, run.k}});
    run.part = known->second;
    const auto nodes = static_cast<std::uint64_t>(run.end - run.begin);
    cut.parts[run.part].nodes += nodes;
    left_[part.region] += nodes;
    cut.runs.push_back(run);
  }

  const RegionGrid& grid_;
  const std::vector<CutPlane>& planes_;
  std::vector<double> reach_mm_;                      // of each plane
  std::map<std::uint32_t, std::uint32_t> number_of_;  // of parts, in the cut grid
  std::map<Region, std::uint64_t> left_;              // nodes
  std::set<Region> touched_;                          // by a plane
};

}  // namespace

RegionGrid cut_grid(const RegionGrid& grid, const std::vector<CutPlane>& planes) {
  return GridCutter(grid, planes).cut();
}

}  // namespace scantet
