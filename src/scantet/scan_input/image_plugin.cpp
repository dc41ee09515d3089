// The level-set opener: reads a scan through ITK and hands the mesher its trilinear level set. What `scantet info` says
// of a scan is put together in image_info.cpp.
#include "scantet/scan_input/image_plugin.h"

#include "scantet/base/error.h"
#include "scantet/field/label_map.h"
#include "scantet/field/scan_statistics.h"
#include "scantet/io/input_files.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/reading/suggested_level.h"
#include "scantet/scan_input/component_options.h"
#include "scantet/scan_input/image_info.h"
#include "scantet/scan_input/scan_object.h"
#include "scantet/scan_input/simplify_options.h"

namespace scantet {
namespace {

const char* const kGroup = "Grey image";

class ImagePlugin final : public InputPlugin {
 public:
  std::string name() const override { return "image"; }
  std::string description() const override {
    return "grey images: NRRD, NIfTI, MetaImage, a DICOM series folder, TIFF stack";
  }
  int can_open(const std::string& input) const override { return can_read_scan(input); }
  void declare_options(OptionSet& options) override;
  OpenedDomain open(const std::string& input, Progress& progress) override;
  std::vector<InfoSection> info(const std::string& input, Progress& progress) override;

 private:
  NestedLevelSettings settings(const std::vector<double>& levels) const { return {levels, inside_, outside_}; }
  [[noreturn]] void refuse_missing_level(const std::string& input, const Scan& scan) const;

  std::vector<double> levels_;
  InsideSide inside_ = InsideSide::above;
  std::optional<double> outside_;
  bool as_grey_ = false;
  ComponentOptions components_;
  SimplifyOptions simplify_;
};

void ImagePlugin::declare_options(OptionSet& options) {
  options.add("level", levels_, Range(),
              {kGroup, "V", "a level",
               "Value of the surface, in the units of the voxels. Needed to mesh a grey image; scantet info suggests "
               "one. Given several times: regions inside each other, 1 between the outermost level and the next, and "
               "so on.",
               0, "required to mesh"});
  options.add("inside", inside_, {{"above", InsideSide::above}, {"below", InsideSide::below}},
              {kGroup, "SIDE", "a side", "Which side of the level is the object."});
  options.add(
      "outside", outside_, Range(),
      {kGroup, "V", "a value",
       "Value of the field one voxel beyond the image, on the outside of the level: it closes the surface at the "
       "border.",
       0, "smallest value of the image; largest with --inside below"});
  options.add(
      "as-grey", as_grey_,
      {kGroup, "", "a flag",
       "Take the values of a label map, whose numbers name things, for grey values. Without this it is refused, "
       "as a surface between two numbers is none of the labels'."});
  components_.declare(options, kGroup);
  simplify_.declare(options, kGroup);
}

void ImagePlugin::refuse_missing_level(const std::string& input, const Scan& scan) const {
  const std::string suggested = number_text(suggested_level(scan));
  throw Error(Fault::usage, "usage.level_missing",
              "--level is missing: " + input + " is a grey image with values from " + number_text(scan.min_value) +
                  " to " + number_text(scan.max_value) + ", and the surface is where they cross the level",
              "try --level " + suggested + " (Otsu's threshold), or look at scantet info " + input);
}

OpenedDomain ImagePlugin::open(const std::string& input, Progress& progress) {
  const Simplification how = simplify_.simplification();
  Scan scan = read_scan(input, progress);
  if (progress.cancelled()) return {};
  if (!as_grey_) refuse_labels(scan, input);
  const Scan simple = simplified(std::exchange(scan, {}), how);
  if (levels_.empty()) refuse_missing_level(input, simple);
  OpenedDomain opened = open_object(simple, settings(levels_), components_.choice(), progress);
  if (how.is_any()) opened.notes.push_back(simplification_note(how));
  opened.files = input_files(input);
  return opened;
}

std::vector<InfoSection> ImagePlugin::info(const std::string& input, Progress& progress) {
  const Simplification how = simplify_.simplification();
  const Scan read = read_scan(input, progress);
  if (progress.cancelled()) return {};
  const std::optional<LabelMap> labels = find_labels(read);
  if (labels && !as_grey_) {
    if (!levels_.empty()) refuse_labels(read, input);
    return describe_label_map(read, *labels);
  }
  const Scan scan = simplified(read, how);
  const ScanStatistics statistics = statistics_of(scan);
  const double suggested = suggested_level(scan);
  std::vector<InfoSection> sections = describe_scan(scan, statistics, suggested);
  if (how.is_any()) sections.insert(sections.begin(), describe_simplification(how));
  const std::vector<double> levels = levels_.empty() ? std::vector{suggested} : levels_;
  const ScanObject kept = find_object(scan, settings(levels), components_.choice(), progress);
  if (kept.domain == nullptr) return {};
  for (InfoSection& section : describe_levels(scan, settings(levels), !levels_.empty())) {
    sections.push_back(std::move(section));
  }
  for (InfoSection& section : describe_regions(*kept.domain, levels.size())) sections.push_back(std::move(section));
  if (kept.dropped) {
    sections.push_back(describe_dropped(*kept.dropped, levels.size()));
    if (components_.min_volume_mm3) add_cavities(kept.cavities, sections.back());
  }
  if (components_.fill_cavities_mm3) sections.push_back(describe_filled(kept.filled));
  return sections;
}

}  // namespace

std::unique_ptr<InputPlugin> make_image_plugin() {
  return std::make_unique<ImagePlugin>();
}

}  // namespace scantet
