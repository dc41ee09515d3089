// Nothing is computed here; counts and shares come from image/, this file names and orders them.
#include "scantet/scan_input/image_info.h"

#include <algorithm>

#include "scantet/base/known_sum.h"
#include "scantet/field/label_map.h"

namespace scantet {
namespace {

constexpr std::size_t kVolumesListed = 10;

std::vector<double> as_list(const Vec& v) {
  return {v.x, v.y, v.z};
}

InfoSection describe_values(const Scan& scan, const ScanStatistics& statistics, double suggested) {
  InfoSection section{"values", "Values", {}};
  section.entries = {{"min", "smallest", statistics.min, ""},
                     {"max", "largest", statistics.max, ""},
                     {"mean", "mean", statistics.mean, ""},
                     {"standard_deviation", "standard deviation", statistics.standard_deviation, ""}};
  for (std::size_t i = 0; i < kPercents.size(); ++i) {
    const std::string percent = std::to_string(kPercents[i]);
    section.entries.push_back({"p" + percent, percent + " % are at most", statistics.percentiles[i], ""});
  }
  section.entries.push_back({"suggested_level", "suggested level (Otsu)", suggested, ""});
  if (const auto count = few_whole_values(scan)) {
    section.entries.push_back(
        {"whole_values", "few whole values", std::int64_t{*count}, "(--labels all if they name things)"});
  }
  return section;
}

InfoSection describe_border(const Scan& scan, double level, InsideSide inside, bool given) {
  InfoSection section{"border", "At the border of the image", {}};
  section.entries.push_back({"level", given ? "at the level given" : "at the suggested level", level, ""});
  section.entries.push_back({"inside", "inside is", std::string(inside == InsideSide::above ? "above" : "below"), ""});
  bool touches = false;
  for (const FaceTouch& face : border_touch(scan, level, inside)) {
    touches = touches || face.share > 0;
    section.entries.push_back({"face_" + face.face + "_percent",
                               "inside on face " + face.face + " (" + face.anatomical + ")", 100 * face.share,
                               "% of its voxels"});
  }
  section.entries.push_back({"touches", "object reaches the border", touches, ""});
  return section;
}

InfoSection describe_values_at(const ValuesAtLevel& at) {
  InfoSection section{"at_level", "Voxels at that level", {{"voxels", "voxels of that very value", at.voxels, ""}}};
  if (at.voxels > 0) {
    section.entries.push_back({"gaps", "that part the inside, without width", at.gaps, ""});
    section.entries.push_back({"clear_level", "level that parts all alike, with width", at.clear_level, ""});
  } else if (at.saddles > 0) {
    section.entries.push_back({"saddles", "saddles between voxels of that very value", at.saddles, ""});
    section.entries.push_back({"meshed_level", "level that is meshed instead, all alike", at.clear_level, ""});
  }
  return section;
}

InfoEntry describe_largest(std::vector<double> volumes_mm3) {
  std::sort(volumes_mm3.rbegin(), volumes_mm3.rend());
  if (volumes_mm3.size() > kVolumesListed) volumes_mm3.resize(kVolumesListed);
  return {"largest_mm3", "largest components, about", volumes_mm3, "mm^3"};
}

/// Handles and Euler number of the boundaries of components, as far as they are known. which: what the keys begin with;
/// of: what the labels end with.
void add_boundary(const std::vector<Component>& components, const std::string& which, const std::string& of,
                  InfoSection& section) {
  std::optional<std::int64_t> handles = 0;
  std::optional<std::int64_t> euler = 0;
  for (const Component& component : components) {
    handles = known_sum(handles, component.handles());
    euler = known_sum(euler, component.euler);
  }
  if (handles) section.entries.push_back({which + "handles", "handles" + of, *handles, ""});
  if (euler) section.entries.push_back({which + "euler", "Euler number of the boundary" + of, *euler, ""});
}

/// cavities: list those, too.
InfoSection describe_region(const std::vector<Component>& components, Region region, bool cavities) {
  InfoSection section{"components", "Components at that level", {}};
  std::vector<Component> mine;
  std::int64_t holes = 0;
  std::int64_t at_border = 0;
  std::vector<double> volumes;
  for (const Component& component : components) {
    if (component.region == kOutside) ++holes;
    if (component.region != region) continue;
    if (component.touches_border) ++at_border;
    volumes.push_back(component.volume_mm3);
    mine.push_back(component);
  }
  const auto count = static_cast<std::int64_t>(volumes.size());
  section.entries.push_back({"components", "components", count, ""});
  if (cavities) section.entries.push_back({"cavities", "cavities", holes, ""});
  section.entries.push_back({"at_border", "components that reach the border", at_border, ""});
  add_boundary(mine, "", "", section);
  if (mine.size() > 1) {
    const auto largest = std::max_element(
        mine.begin(), mine.end(), [](const Component& a, const Component& b) { return a.volume_mm3 < b.volume_mm3; });
    add_boundary({*largest}, "largest_", " of the largest component", section);
  }
  section.entries.push_back(describe_largest(std::move(volumes)));
  return section;
}

}  // namespace

InfoSection describe_grid(const Scan& scan) {
  const Orientation orientation = orientation_of(scan.frame);
  const Frame& frame = scan.frame;
  InfoSection section{"image", "Image", {}};
  section.entries = {
      {"format", "format", scan.format, ""},
      {"pixel_type", "pixel type", scan.pixel_type, ""},
      {"size", "size", std::vector<double>(scan.size.begin(), scan.size.end()), "voxels"},
      {"spacing_mm", "spacing", std::vector<double>{frame.spacing_mm(0), frame.spacing_mm(1), frame.spacing_mm(2)},
       "mm"},
      {"origin_mm", "origin (LPS)", as_list(frame.origin()), "mm"},
      {"orientation", "orientation (i, j, k grow to)", orientation.code, ""},
      {"oblique", "oblique", orientation.oblique, ""},
      {"sheared", "sheared", orientation.sheared, ""},
      {"left_handed", "left-handed (mirrored) grid", orientation.left_handed, ""},
      {"column_i_mm", "step of i (LPS)", as_list(frame.column(0)), "mm"},
      {"column_j_mm", "step of j (LPS)", as_list(frame.column(1)), "mm"},
      {"column_k_mm", "step of k (LPS)", as_list(frame.column(2)), "mm"},
  };
  return section;
}

std::vector<InfoSection> describe_scan(const Scan& scan, const ScanStatistics& statistics, double suggested_level) {
  return {describe_grid(scan), describe_values(scan, statistics, suggested_level)};
}

std::vector<InfoSection> describe_levels(const Scan& scan, const NestedLevelSettings& settings,
                                         const std::vector<ValuesAtLevel>& at, bool given) {
  const std::vector<double>& levels = settings.levels;
  std::vector<InfoSection> sections;
  for (std::size_t n = 0; n < levels.size(); ++n) {
    for (InfoSection section : {describe_border(scan, levels[n], settings.inside, given), describe_values_at(at[n])}) {
      if (levels.size() > 1) {
        section.key += "_" + std::to_string(n + 1);
        section.title += ", level " + number_text(levels[n]);
      }
      sections.push_back(std::move(section));
    }
  }
  return sections;
}

std::vector<InfoSection> describe_regions(const Domain& domain, std::size_t regions) {
  const std::vector<Component> components = domain.components();
  std::vector<InfoSection> sections;
  for (std::size_t n = 1; n <= regions; ++n) {
    sections.push_back(describe_region(components, static_cast<Region>(n), n == 1));
    if (regions == 1) break;
    sections.back().key += "_" + std::to_string(n);
    sections.back().title = "Components of region " + std::to_string(n);
  }
  return sections;
}

InfoSection describe_dropped(const DroppedComponents& dropped, std::size_t regions) {
  std::vector<double> volumes;
  std::vector<std::int64_t> counts(regions);
  for (const Component& component : dropped.components) {
    volumes.push_back(component.volume_mm3);
    ++counts.at(static_cast<std::size_t>(component.region) - 1);
  }
  InfoSection section{"dropped",
                      "Dropped",
                      {{"found", "components before", static_cast<std::int64_t>(dropped.found), ""},
                       {"components", "components dropped", static_cast<std::int64_t>(volumes.size()), ""},
                       describe_largest(std::move(volumes))}};
  for (std::size_t n = 0; n < regions && regions > 1; ++n) {
    const std::string region = std::to_string(n + 1);
    section.entries.push_back({"region_" + region, "of region " + region, counts[n], ""});
  }
  return section;
}

InfoSection describe_filled(const FilledCavities& filled) {
  return {"filled",
          "Cavities filled",
          {{"cavities", "cavities filled", static_cast<std::int64_t>(filled.count), ""},
           {"volume_mm3", "of together", filled.volume_mm3, "mm^3"},
           {"largest_mm3", "the largest of them", filled.largest_mm3, "mm^3"}}};
}

void add_cavities(const SmallCavities& cavities, InfoSection& dropped) {
  dropped.entries.push_back(
      {"small_cavities", "cavities below that stay", static_cast<std::int64_t>(cavities.count), ""});
  if (cavities.count == 0) return;
  dropped.entries.push_back({"smallest_cavity_mm3", "the smallest of them", cavities.least_mm3, "mm^3"});
}

}  // namespace scantet
