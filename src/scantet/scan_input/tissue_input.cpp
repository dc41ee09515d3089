#include "scantet/scan_input/tissue_input.h"

#include <filesystem>

#include "scantet/labels/label_grid.h"
#include "scantet/labels/label_names.h"
#include "scantet/labels/probability_field.h"
#include "scantet/scan_input/label_object_input_impl.h"

namespace scantet {

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

void TissueMaps::rename(const std::string& table) {
  const LabelTable known = read_label_table(table);
  for (std::size_t n = 1; n <= maps.size(); ++n) {
    const auto region = static_cast<Region>(n);
    if (const auto name = known.names.find(region); name != known.names.end()) names[region] = name->second;
    if (const auto color = known.colors.find(region); color != known.colors.end()) colors[region] = color->second;
  }
}

OpenedDomain open_tissues(const TissueMaps& tissues, Progress& progress) {
  LabelObject object = make_tissue_object(tissues.maps, tissues.names, progress);
  if (object.domain == nullptr) return {};
  OpenedDomain opened = opened_of(std::move(object), tissues.maps.front());
  opened.colors = tissues.colors;
  if (are_percents(tissues.maps)) opened.notes.push_back("the maps' bytes are percents: they come to 127 at most");
  return opened;
}

InfoSection describe_tissues(const TissueMaps& tissues, Progress& progress) {
  const std::shared_ptr<const LabelField> field = make_probability_field(tissues.maps, progress);
  if (field == nullptr) return {};
  InfoSection section{"tissues", "Probability maps", {}};
  section.entries = {{"count", "tissues", static_cast<std::int64_t>(tissues.maps.size()), ""},
                     {"percents", "values are percents", are_percents(tissues.maps), ""}};
  add_regions(grid_of_voxels(*field), tissues.names, "tissue", section);
  return section;
}

}  // namespace scantet
