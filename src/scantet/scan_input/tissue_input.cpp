#include "scantet/scan_input/tissue_input.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "scantet/base/error.h"
#include "scantet/base/name_list.h"
#include "scantet/cuts/continued_scan.h"
#include "scantet/labels/label_count.h"
#include "scantet/labels/label_grid.h"
#include "scantet/labels/label_names.h"
#include "scantet/labels/object_of_field.h"
#include "scantet/scan_input/label_object_input_impl.h"

namespace scantet {
namespace {

/// As make_tissue_object(), of maps that may have been made simpler. Without a domain if cancelled.
LabelObject tissue_object(const TissueMaps& tissues, Progress& progress) {
  LabelAccount account;
  const auto field = make_probability_field(tissues.maps, tissues.units, tissues.regions, progress);
  if (field != nullptr) account.lost = regions_without_voxels(*field);
  return label_object_of(field, tissues.names, std::move(account), progress, Tracing::when_asked);
}

/// lost: at least one.
std::string note_on_lost(const std::vector<Region>& lost, const std::map<Region, std::string>& names) {
  constexpr std::size_t kMostNamed = 10;
  std::vector<std::string> named;
  named.reserve(lost.size());
  for (const Region region : lost) {
    const auto name = names.find(region);
    named.push_back(std::to_string(region) + (name == names.end() ? "" : " (" + name->second + ")"));
  }
  const bool one = lost.size() == 1;
  return (one ? "nowhere is tissue " : "nowhere are tissues ") + name_list(named, kMostNamed) +
         " more likely than all others: " + (one ? "it is" : "they are") + " not in the mesh";
}

}  // namespace

void TissueMaps::add(std::vector<Scan> volumes, const std::string& file) {
  const std::string base = std::filesystem::path(file).filename().string();
  const std::string stem = base.substr(0, base.find('.'));
  const std::vector<ScanSegment> segments = volumes.front().segments;
  for (std::size_t n = 0; n < volumes.size(); ++n) {
    maps.push_back(std::move(volumes[n]));
    const auto region = static_cast<Region>(maps.size());
    names[region] = volumes.size() == 1 ? stem : stem + "_" + std::to_string(n + 1);
    if (segments.size() != volumes.size()) continue;
    if (!segments[n].name.empty()) names[region] = segments[n].name;
    if (segments[n].color) colors[region] = *segments[n].color;
  }
}

void TissueMaps::choose(const LabelOptions& options) {
  const MapUnits all = find_map_units(maps);
  std::vector<LabelCount> tissues;
  for (std::size_t n = 1; n <= maps.size(); ++n) tissues.push_back({static_cast<std::int64_t>(n), 0});
  LabelTable known{{names.begin(), names.end()}, {colors.begin(), colors.end()}};
  const LabelSettings settings = chosen_labels(options, std::move(known), tissues);
  const std::vector<Region> becomes = regions_of_labels(labels_of(tissues), settings);
  std::vector<Scan> added = std::exchange(maps, {});
  units = {{}, all.percents, all.masks};
  for (std::size_t n = 0; n < added.size(); ++n) {
    if (becomes[n] == kOutside) continue;
    maps.push_back(std::move(added[n]));
    units.divisors.push_back(all.divisors[n]);
    regions.push_back(becomes[n]);
  }
  dropped = added.size() - maps.size();
  names = settings.names;
  colors = settings.colors;
  if (!maps.empty()) return;
  throw Error(Fault::usage, "usage.labels", "--labels: all tissues are background", "choose one at least");
}

void TissueMaps::simplify(const Simplification& how) {
  for (Scan& map : maps) map = simplified(std::exchange(map, {}), how);
}

void TissueMaps::go_on_beyond(const std::vector<CutPlane>& planes) {
  for (Scan& map : maps) map = continued_beyond(std::exchange(map, {}), planes);
}

OpenedDomain open_tissues(const TissueMaps& tissues, Progress& progress) {
  LabelObject object = tissue_object(tissues, progress);
  if (object.domain == nullptr) return {};
  const std::vector<Region> lost = object.lost;
  OpenedDomain opened = opened_of(std::move(object), tissues.maps.front());
  opened.colors = tissues.colors;
  if (tissues.units.percents) opened.notes.push_back("the maps' bytes are percents: they come to 127 at most");
  if (tissues.units.masks) opened.notes.push_back("the maps' bytes are masks: each is 0 or 1");
  if (tissues.dropped > 0) {
    opened.notes.push_back(note_on_dropped(tissues.dropped, "tissue"));
  }
  if (!lost.empty()) opened.notes.push_back(note_on_lost(lost, tissues.names));
  return opened;
}

InfoSection describe_tissues(const TissueMaps& tissues, Progress& progress) {
  const auto field = make_probability_field(tissues.maps, tissues.units, tissues.regions, progress);
  if (field == nullptr) return {};
  RegionGrid grid = grid_of_voxels(*field);
  for (const Region lost : regions_without_voxels(*field)) grid.regions.push_back({lost, 0, 0});
  std::sort(grid.regions.begin(), grid.regions.end(),
            [](const GridRegion& a, const GridRegion& b) { return a.region < b.region; });
  InfoSection section{"tissues", "Probability maps", {}};
  section.entries = {{"count", "tissues", static_cast<std::int64_t>(tissues.maps.size()), ""},
                     {"percents", "values are percents", tissues.units.percents, ""},
                     {"masks", "values are masks", tissues.units.masks, ""}};
  add_regions(grid, tissues.names, "tissue", section);
  return section;
}

}  // namespace scantet
