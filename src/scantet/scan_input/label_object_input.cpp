#include <cmath>

#include "scantet/labels/label_contacts.h"
#include "scantet/scan_input/label_object_input_impl.h"

namespace scantet {
namespace {

FittedDomain fitted_of(LabelObject&& object) {
  FittedDomain fitted{std::move(object.domain), std::move(object.grid), std::move(object.phases)};
  if (object.settle) {
    fitted.settle = [settle = std::move(object.settle)](const std::map<Region, double>& volumes_mm3,
                                                        std::span<const Point> held, Progress& progress) {
      return fitted_of(settle(volumes_mm3, held, progress));
    };
  }
  return fitted;
}

}  // namespace

OpenedDomain opened_of(LabelObject&& object, const Scan& scan) {
  constexpr double kVoxelsPerSize = 2;
  OpenedDomain opened;
  opened.domain = std::move(object.domain);
  opened.grid = std::move(object.grid);
  opened.phases = std::move(object.phases);
  if (object.fit) {
    opened.fit = [fit = std::move(object.fit)](const FacetSizes& facets, Progress& progress) {
      return fitted_of(fit(facets, progress));
    };
  }
  opened.frame = scan.frame;
  opened.border = border_planes(scan.frame, scan.size);
  opened.default_size_mm = kVoxelsPerSize * scan.frame.min_spacing_mm();
  opened.default_size_reason = number_text(kVoxelsPerSize) + " x the smallest voxel spacing";
  return opened;
}

LabelSettings chosen_labels(const LabelOptions& options, LabelTable known, const std::vector<LabelCount>& labels) {
  const LabelChoice choice = read_label_choice("--labels", options.labels);
  LabelTable table = options.names.empty() ? LabelTable() : read_label_table(options.names);
  table.merge(std::move(known));
  return settings_of(choice, table, labels, static_cast<std::int64_t>(options.background));
}

std::string note_on_dropped(std::size_t count, const std::string& word) {
  return std::to_string(count) + " " + word + (count == 1 ? " is" : "s are") +
         " not chosen, and part of the background";
}

void add_regions(const RegionGrid& grid, const std::map<Region, std::string>& names, const std::string& word,
                 InfoSection& section) {
  std::map<Region, std::int64_t> parts;
  for (const GridPart& part : grid.parts) ++parts[part.region];
  const std::map<Region, std::set<Region>> contacts = regions_in_contact(grid);
  const double voxel_mm3 = std::abs(grid.frame.determinant_mm3());
  std::uint64_t background = static_cast<std::uint64_t>(grid.size[0]) * static_cast<std::uint64_t>(grid.size[1]) *
                             static_cast<std::uint64_t>(grid.size[2]);
  for (const GridRegion& region : grid.regions) background -= region.nodes;
  const auto add_size = [&](Region region, const std::string& what, std::uint64_t voxels) {
    const std::string number = std::to_string(region);
    section.entries.push_back({"voxels_" + number, what, static_cast<std::int64_t>(voxels), "voxels"});
    section.entries.push_back({"volume_" + number + "_mm3", what, static_cast<double>(voxels) * voxel_mm3, "mm^3"});
  };
  if (background > 0) add_size(kOutside, "background", background);
  for (const GridRegion& region : grid.regions) {
    const std::string number = std::to_string(region.region);
    const std::string what = word + " " + number;
    const auto name = names.find(region.region);
    if (name != names.end()) section.entries.push_back({"name_" + number, what, name->second, ""});
    add_size(region.region, what, region.nodes);
    section.entries.push_back({"parts_" + number, what + ", parts (6-connected)", parts[region.region], ""});
    const auto touched = contacts.find(region.region);
    std::vector<double> others;
    if (touched != contacts.end()) others.assign(touched->second.begin(), touched->second.end());
    section.entries.push_back({"touches_" + number, what + " touches", others, ""});
  }
}

}  // namespace scantet
