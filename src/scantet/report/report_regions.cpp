// Colours go round the circle of hues by the golden angle, so that numbers close to each other get hues far apart, and
// change lightness every few steps.
#include "scantet/report/report_regions.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scantet {
namespace {

std::optional<double> percent_more(double value, double reference) {
  if (!(reference > 0)) return std::nullopt;
  return 100 * (value / reference - 1);
}

}  // namespace

bool ReportRegion::is_whole() const {
  return grid && !std::isnan(grid->grid.volume_mm3);
}

double ReportRegion::area_mm2() const {
  double sum = 0;
  for (const ReportNeighbor& neighbor : neighbors) sum += neighbor.area_mm2;
  return sum;
}

std::optional<double> ReportRegion::off_voxels_percent() const {
  return is_whole() ? percent_more(mesh.volume_mm3, voxels_mm3) : std::nullopt;
}

std::optional<double> ReportRegion::off_field_percent() const {
  return is_whole() ? percent_more(mesh.volume_mm3, grid->grid.volume_mm3) : std::nullopt;
}

Color region_color(Region region) {
  constexpr double kGolden = 0.61803398874989485;  // of the circle
  constexpr double kFirstHue = 0.06;
  constexpr std::array<std::array<double, 2>, 3> kTones{
      {{0.62, 0.84}, {0.45, 0.96}, {0.75, 0.62}}};  // saturation, value
  const auto number = static_cast<std::uint32_t>(region);
  const double hue = 6 * std::fmod(kFirstHue + kGolden * (number % 100'000), 1.0);
  const auto [saturation, value] = kTones[number % kTones.size()];
  const auto channel = [&, saturation = saturation, value = value](double shift) {
    const double k = std::fmod(shift + hue, 6.0);
    const double share = std::clamp(std::min(k, 4 - k), 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255 * value * (1 - saturation * share)));
  };
  return {channel(5), channel(3), channel(1)};
}

std::string color_text(const Color& color) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t part : {color.red, color.green, color.blue}) {
    text += kDigits[part >> 4U];
    text += kDigits[part & 15U];
  }
  return text;
}

std::vector<ReportRegion> report_regions(const TetMesh& mesh, const QualitySummary& quality, const AuditReport& audit,
                                         const std::map<Region, Color>& colors, double voxel_mm3) {
  std::map<Region, ReportRegion> regions;
  for (const RegionVolume& volume : quality.regions) regions[volume.region].mesh = volume;
  for (const MeshComponent& component : audit.components) ++regions[component.region].components;
  for (const MeshInterface& shared : audit.interfaces) {
    const auto& [behind, front] = shared.regions;
    regions[behind].neighbors.push_back({front, shared.area_mm2, shared.facets});
    if (front != kOutside) regions[front].neighbors.push_back({behind, shared.area_mm2, shared.facets});
  }
  if (audit.region_ledger) {
    for (const KeptRegion& kept : audit.region_ledger->regions) {
      ReportRegion& region = regions[kept.grid.region];
      region.grid = kept;
      region.voxels_mm3 = voxel_mm3 * static_cast<double>(kept.grid.nodes);
    }
  }
  std::vector<ReportRegion> list;
  for (auto& [number, region] : regions) {
    region.region = region.mesh.region = number;
    region.name = number == kOutside ? "background" : region_name(mesh, number);
    const auto given = colors.find(number);
    region.color = given == colors.end() ? region_color(number) : given->second;
    std::sort(region.neighbors.begin(), region.neighbors.end(),
              [](const ReportNeighbor& a, const ReportNeighbor& b) { return a.region < b.region; });
    list.push_back(std::move(region));
  }
  return list;
}

}  // namespace scantet
