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
#include "scantet/scan_input/label_input.h"
#include "scantet/scan_input/scan_object.h"
#include "scantet/scan_input/simplify_options.h"

namespace scantet {
namespace {

const char* const kGroup = "Grey image";

class ImagePlugin final : public InputPlugin {
 public:
  explicit ImagePlugin(std::shared_ptr<const ScansInMemory> in_memory) : in_memory_(std::move(in_memory)) {}
  std::string name() const override { return "image"; }
  std::string description() const override {
    return "grey images and label maps: NRRD, NIfTI, MetaImage, a DICOM series folder, TIFF stack";
  }
  int can_open(const std::string& input) const override { return in_memory(input) ? 100 : can_read_scan(input); }
  void declare_options(OptionSet& options) override;
  OpenedDomain open(const std::string& input, Progress& progress) override;
  std::vector<InfoSection> info(const std::string& input, Progress& progress) override;

 private:
  /// Null if it is a file.
  const Scan* in_memory(const std::string& input) const;
  Scan read(const std::string& input, Progress& progress, bool may_be_constant = false) const;
  std::vector<std::string> files_of(const std::string& input) const;
  NestedLevelSettings settings(const std::vector<double>& levels) const { return {levels, inside_, outside_}; }
  [[noreturn]] void refuse_missing_level(const std::string& input, const Scan& scan) const;
  /// Of probability maps.
  OpenedDomain open_maps(const std::string& input, Progress& progress);
  /// Why the scan is taken for a label map; nullopt if it is not.
  std::optional<std::string> reason_for_labels(const Scan& scan) const;
  void refuse_options_of_levels(const std::string& input, const std::string& reason) const;

  std::shared_ptr<const ScansInMemory> in_memory_;
  std::vector<double> levels_;
  InsideSide inside_ = InsideSide::above;
  std::optional<double> outside_;
  bool as_grey_ = false;
  ComponentOptions components_;
  SimplifyOptions simplify_;
  LabelOptions labels_;
};

const Scan* ImagePlugin::in_memory(const std::string& input) const {
  if (in_memory_ == nullptr) return nullptr;
  const auto found = in_memory_->find(input);
  return found == in_memory_->end() ? nullptr : &found->second;
}

Scan ImagePlugin::read(const std::string& input, Progress& progress, bool may_be_constant) const {
  const Scan* const scan = in_memory(input);
  return scan ? *scan : read_scan(input, progress, may_be_constant);
}

std::vector<std::string> ImagePlugin::files_of(const std::string& input) const {
  return in_memory(input) ? std::vector<std::string>() : input_files(input);
}

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
       "Take the values of a label map, whose numbers name things, for grey values. A surface between two numbers is "
       "none of the labels'."});
  components_.declare(options, kGroup);
  simplify_.declare(options, kGroup);
  labels_.declare(options);
}

void ImagePlugin::refuse_missing_level(const std::string& input, const Scan& scan) const {
  const std::string suggested = number_text(suggested_level(scan));
  throw Error(Fault::usage, "usage.level_missing",
              "--level is missing: " + input + " is a grey image with values from " + number_text(scan.min_value) +
                  " to " + number_text(scan.max_value) + ", and the surface is where they cross the level",
              "try --level " + suggested + " (Otsu's threshold), or look at scantet info " + input +
                  "; --labels all if its numbers name things");
}

std::optional<std::string> ImagePlugin::reason_for_labels(const Scan& scan) const {
  if (as_grey_) {
    if (!labels_.any()) return std::nullopt;
    throw Error(Fault::usage, "usage.labels", "--as-grey: labels are asked for, too", "leave one of the two out");
  }
  if (const auto found = find_labels(scan)) return found->reason;
  if (labels_.any()) return "--labels or --label-names says so";
  return std::nullopt;
}

void ImagePlugin::refuse_options_of_levels(const std::string& input, const std::string& reason) const {
  const auto refuse = [&](bool given, const std::string& option) {
    if (!given) return;
    throw Error(Fault::input, "input.labels",
                "--" + option + ": " + input + " is a label map: " + reason +
                    "; its numbers name things, and where they cross a level is no surface of any of them",
                "leave out --" + option +
                    " to mesh the labels, each as a region, or give --as-grey to mesh the numbers as if they were grey "
                    "values");
  };
  refuse(!levels_.empty(), "level");
  refuse(inside_ != InsideSide::above, "inside");
  refuse(outside_.has_value(), "outside");
  refuse(!components_.components.empty(), "components");
  refuse(components_.min_volume_mm3.has_value(), "min-component");
  refuse(components_.fill_cavities_mm3.has_value(), "fill-cavities");
  refuse(simplify_.how.median_voxels > 0, "median");
  refuse(simplify_.how.smooth_mm.has_value(), "smooth");
  refuse(simplify_.how.resample_mm.has_value(), "resample");
}

OpenedDomain ImagePlugin::open_maps(const std::string& input, Progress& progress) {
  const bool of_levels = !levels_.empty() || inside_ != InsideSide::above || outside_ || components_.choice();
  if (of_levels || labels_.any() || as_grey_) {
    throw Error(Fault::usage, "usage.labels", "--tissue: levels, components, labels or grey values are asked for, too",
                "leave out one of the two");
  }
  const Simplification how = simplify_.simplification();
  std::vector<std::string> files = labels_.tissues;
  files.insert(files.begin(), input);
  std::vector<Scan> maps;
  std::vector<std::string> read_files;
  for (const std::string& file : files) {
    const bool may_be_constant = true;
    maps.push_back(simplified(read(file, progress, may_be_constant), how));
    if (progress.cancelled()) return {};
    for (const std::string& part : files_of(file)) read_files.push_back(part);
  }
  OpenedDomain opened = open_tissues(maps, files, progress);
  if (how.is_any()) opened.notes.push_back(simplification_note(how));
  opened.files = read_files;
  return opened;
}

OpenedDomain ImagePlugin::open(const std::string& input, Progress& progress) {
  if (!labels_.tissues.empty()) return open_maps(input, progress);
  const Simplification how = simplify_.simplification();
  Scan scan = read(input, progress);
  if (progress.cancelled()) return {};
  const std::optional<std::string> labels = reason_for_labels(scan);
  if (labels) refuse_options_of_levels(input, *labels);
  const Scan simple = simplified(std::exchange(scan, {}), how);
  if (!labels && levels_.empty()) refuse_missing_level(input, simple);
  OpenedDomain opened = labels ? open_labels(simple, input, labels_, progress)
                               : open_object(simple, settings(levels_), components_.choice(), progress);
  if (how.is_any()) opened.notes.push_back(simplification_note(how));
  opened.files = files_of(input);
  return opened;
}

std::vector<InfoSection> ImagePlugin::info(const std::string& input, Progress& progress) {
  const Simplification how = simplify_.simplification();
  const Scan given = read(input, progress);
  if (progress.cancelled()) return {};
  const std::optional<std::string> labels = reason_for_labels(given);
  if (labels) refuse_options_of_levels(input, *labels);
  const Scan scan = simplified(given, how);
  if (labels) {
    std::vector<InfoSection> sections{describe_grid(scan), describe_labels(scan, *labels, input, labels_)};
    if (how.is_any()) sections.insert(sections.begin(), describe_simplification(how));
    return sections;
  }
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

std::unique_ptr<InputPlugin> make_image_plugin(std::shared_ptr<const ScansInMemory> in_memory) {
  return std::make_unique<ImagePlugin>(std::move(in_memory));
}

}  // namespace scantet
