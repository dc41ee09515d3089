#include "scantet/app/region_notes.h"

#include <algorithm>
#include <cmath>

#include "scantet/base/options.h"

namespace scantet {
namespace {

/// Voxels that a mesh of this size passes by are worth knowing, and no fault.
void note_lost_voxels(const RegionLedger& ledger, std::vector<std::string>& notes) {
  std::uint64_t nodes = 0;
  std::uint64_t kept = 0;
  const KeptRegion* worst = nullptr;
  for (const KeptRegion& region : ledger.regions) {
    nodes += region.grid.nodes;
    kept += region.kept;
    const auto lost = [](const KeptRegion& r) { return r.grid.nodes - r.kept; };
    if (lost(region) > 0 && (worst == nullptr || lost(region) > lost(*worst))) worst = &region;
  }
  if (worst == nullptr) return;
  const Point& p = worst->lost.front();
  notes.push_back(std::to_string(nodes - kept) + " of " + std::to_string(nodes) +
                  " voxel centres are not in the mesh's region of their label; most are of " +
                  (worst->grid.region == kOutside ? "the background" : "label " + std::to_string(worst->grid.region)) +
                  ", the first at (" + number_text(p.x, 4) + ", " + number_text(p.y, 4) + ", " + number_text(p.z, 4) +
                  ") mm; a smaller --size keeps more");
}

/// Volumes of large labels that are off by more than people can overlook are worth knowing, and no fault.
void note_volumes_off(const std::vector<ReportRegion>& regions, std::vector<std::string>& notes) {
  constexpr std::uint64_t kLarge = 1000;  // voxels
  constexpr double kMuch = 0.5;           // percent
  const auto off = [](const ReportRegion& r) { return std::abs(r.off_voxels_percent().value_or(0)); };
  const auto is_off = [&](const ReportRegion& r) {
    return r.region != kOutside && r.grid && r.grid->grid.nodes > kLarge && off(r) > kMuch;
  };
  int count = 0;
  const ReportRegion* worst = nullptr;
  for (const ReportRegion& r : regions) {
    if (!is_off(r)) continue;
    ++count;
    if (worst == nullptr || off(r) > off(*worst)) worst = &r;
  }
  if (worst == nullptr) return;
  notes.push_back("the volume of " + std::to_string(count) + (count == 1 ? " label" : " labels") +
                  " of over 1,000 voxels is not within 0.5% of its voxels', most that of " + worst->name + ", by " +
                  number_text(*worst->off_voxels_percent(), 2) + "%; a smaller --size is nearer");
}

/// What is cut has another volume than its label, and no other is known.
void note_volumes_not_compared(const std::vector<ReportRegion>& regions, std::vector<std::string>& notes) {
  const auto is_cut = [](const ReportRegion& r) { return r.grid && r.region != kOutside && !r.is_whole(); };
  const auto count = std::count_if(regions.begin(), regions.end(), is_cut);
  if (count == 0) return;
  notes.push_back("volumes are not held against those of the voxels for " + std::to_string(count) +
                  (count == 1 ? " label that is cut" : " labels that are cut"));
}

/// Parts that touch others of their label by edges or corners of voxels may be one with these in a mesh, and tets with
/// no voxel centre in them apart: no finding is about these.
void note_components(const std::vector<ReportRegion>& regions, const AuditReport& audit,
                     std::vector<std::string>& notes) {
  const auto is_other = [](const ReportRegion& r) {
    return r.components > 0 && r.is_whole() && r.components != r.grid->parts;
  };
  const auto count = std::count_if(regions.begin(), regions.end(), is_other);
  if (count == 0) return;
  const ReportRegion& first = *std::find_if(regions.begin(), regions.end(), is_other);
  const MeshComponent* smallest = nullptr;
  for (const MeshComponent& c : audit.components) {
    const bool is_less = smallest == nullptr || c.volume_mm3 < smallest->volume_mm3;
    if (c.region == first.region && is_less) smallest = &c;
  }
  std::string text = "the mesh has other parts than the input of " + std::to_string(count) +
                     (count == 1 ? " label: " : " labels, the first is ") + first.name + " with " +
                     std::to_string(first.components) + " for " + std::to_string(first.grid->parts);
  if (smallest != nullptr) {
    const Point p = smallest->box_mm.center();
    text +=
        ", the smallest at (" + number_text(p.x, 4) + ", " + number_text(p.y, 4) + ", " + number_text(p.z, 4) + ") mm";
  }
  notes.push_back(text +
                  ": parts that touch by edges or corners of voxels may be one, and tets beside thin parts apart; a "
                  "smaller --size keeps more");
}

}  // namespace

std::vector<std::string> notes_on_regions(const std::vector<ReportRegion>& regions, const AuditReport& audit) {
  std::vector<std::string> notes;
  note_components(regions, audit, notes);
  note_volumes_off(regions, notes);
  note_volumes_not_compared(regions, notes);
  if (audit.region_ledger) note_lost_voxels(*audit.region_ledger, notes);
  return notes;
}

}  // namespace scantet
