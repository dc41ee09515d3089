#include <algorithm>
#include <cmath>
#include <limits>

#include "scantet/report/numbers_impl.h"
#include "scantet/report/region_rows_impl.h"

namespace scantet {
namespace {

constexpr std::size_t kMostRegions = 12;
constexpr std::size_t kMostNeighbors = 5;

/// How far a region is from what it should be.
double trouble(const ReportRegion& region) {
  if (region.mesh.tets == 0) return std::numeric_limits<double>::infinity();
  return std::abs(region.off_voxels_percent().value_or(0));
}

std::string row_of(const ReportRegion& r, const RegionUnits& units) {
  std::string text = std::to_string(r.region);
  if (r.name != "region_" + text) text += " " + r.name;
  if (r.mesh.tets == 0) return text + ": not in the mesh, " + counted(r.grid->grid.nodes, "voxel", "voxels");
  text += ": " + number(r.mesh.volume_mm3) + units.cubic_mm;
  if (const auto off = r.off_voxels_percent()) {
    text += std::string(" (voxels' ") + (*off < 0 ? "-" : "+") + printed(std::abs(*off), std::chars_format::fixed, 2) +
            " %)";
  }
  text += ", dihedral from " + number(r.mesh.min_dihedral_deg) + units.degrees + ", " +
          counted(r.components, "component", "components");
  if (r.grid && r.grid->parts != r.components) text += " (the input has " + grouped(r.grid->parts) + ")";
  text += ", beside";
  for (std::size_t n = 0; n < std::min(r.neighbors.size(), kMostNeighbors); ++n) {
    const ReportNeighbor& neighbor = r.neighbors[n];
    text += (n == 0 ? " " : ", ") + std::to_string(neighbor.region) + " (" + number(neighbor.area_mm2) +
            units.square_mm + ")";
  }
  const std::size_t others = r.neighbors.size() - std::min(r.neighbors.size(), kMostNeighbors);
  return others > 0 ? text + " and " + grouped(others) + " more" : text;
}

}  // namespace

std::vector<std::string> region_rows(const std::vector<ReportRegion>& regions, const RegionUnits& units) {
  std::vector<const ReportRegion*> shown;
  for (const ReportRegion& region : regions) {
    if (region.region != kOutside) shown.push_back(&region);
  }
  const std::size_t count = shown.size();
  if (count > kMostRegions) {
    std::stable_sort(shown.begin(), shown.end(),
                     [](const ReportRegion* a, const ReportRegion* b) { return trouble(*a) > trouble(*b); });
    shown.resize(kMostRegions);
  }
  std::vector<std::string> rows;
  rows.reserve(shown.size() + 1);
  for (const ReportRegion* region : shown) rows.push_back(row_of(*region, units));
  if (count > kMostRegions) rows.push_back("and " + grouped(count - kMostRegions) + " more: a report file has all");
  return rows;
}

std::string voxel_row(const std::vector<ReportRegion>& regions) {
  std::uint64_t nodes = 0;
  std::uint64_t kept = 0;
  for (const ReportRegion& region : regions) {
    if (!region.grid) continue;
    nodes += region.grid->grid.nodes;
    kept += region.grid->kept;
  }
  if (nodes == 0) return "";
  if (nodes == kept) return "all " + grouped(nodes) + " centres are in the region of their label";
  return grouped(kept) + " of " + grouped(nodes) + " centres are in the region of their label (" +
         percent_text(kept, nodes) + "), " + grouped(nodes - kept) + " are not";
}

}  // namespace scantet
