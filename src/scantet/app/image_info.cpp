// Nothing is computed here; counts and shares come from image/, this file names and orders them.
#include "scantet/app/image_info.h"

#include <algorithm>

namespace scantet {
namespace {

constexpr std::size_t kVolumesListed = 10;

std::vector<double> as_list(const Vec& v) {
  return {v.x, v.y, v.z};
}

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

InfoSection describe_values(const ScanStatistics& statistics, double suggested) {
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
  return section;
}

}  // namespace

std::vector<InfoSection> describe_scan(const Scan& scan, const ScanStatistics& statistics, double suggested_level) {
  return {describe_grid(scan), describe_values(statistics, suggested_level)};
}

InfoSection describe_border(const Scan& scan, const LevelSetSettings& settings, bool given) {
  InfoSection section{"border", "At the border of the image", {}};
  section.entries.push_back({"level", given ? "at the level given" : "at the suggested level", settings.level, ""});
  section.entries.push_back(
      {"inside", "inside is", std::string(settings.inside == InsideSide::above ? "above" : "below"), ""});
  bool touches = false;
  for (const FaceTouch& face : border_touch(scan, settings.level, settings.inside)) {
    touches = touches || face.share > 0;
    section.entries.push_back({"face_" + face.face + "_percent",
                               "inside on face " + face.face + " (" + face.anatomical + ")", 100 * face.share,
                               "% of its voxels"});
  }
  section.entries.push_back({"touches", "object reaches the border", touches, ""});
  return section;
}

InfoSection describe_components(const Domain& domain) {
  InfoSection section{"components", "Components at that level", {}};
  std::int64_t counts[2] = {0, 0};  // of the inside, cavities
  std::int64_t at_border = 0;
  std::vector<double> volumes;
  for (const Component& component : domain.components()) {
    const bool cavity = component.region == kOutside;
    ++counts[cavity ? 1 : 0];
    if (component.touches_border && !cavity) ++at_border;
    if (!cavity) volumes.push_back(component.volume_mm3);
  }
  std::sort(volumes.rbegin(), volumes.rend());
  if (volumes.size() > kVolumesListed) volumes.resize(kVolumesListed);
  section.entries = {{"components", "components", counts[0], ""},
                     {"cavities", "cavities", counts[1], ""},
                     {"at_border", "components that reach the border", at_border, ""},
                     {"largest_mm3", "largest components, about", volumes, "mm^3"}};
  return section;
}

}  // namespace scantet
