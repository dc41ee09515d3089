// The level-set opener: reads a scan through ITK and hands the mesher its trilinear level set. What `scantet info` says
// of a scan is put together in image_info.cpp.
#include "scantet/scan_input/image_plugin.h"

#include "scantet/base/error.h"
#include "scantet/field/label_map.h"
#include "scantet/field/scan_statistics.h"
#include "scantet/io/input_files.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/reading/suggested_level.h"
#include "scantet/scan_input/clear_levels.h"
#include "scantet/scan_input/component_options.h"
#include "scantet/scan_input/handle_option.h"
#include "scantet/scan_input/image_info.h"
#include "scantet/scan_input/label_input.h"
#include "scantet/scan_input/scan_object.h"
#include "scantet/scan_input/simplify_options.h"
#include "scantet/scan_input/tissue_input.h"

namespace scantet {
namespace {

const char* const kGroup = "Grey image";
const char* const kLabelGroup = "Label map";

class ImagePlugin final : public InputPlugin {
 public:
  explicit ImagePlugin(std::shared_ptr<const ScansInMemory> in_memory) : in_memory_(std::move(in_memory)) {}
  std::string name() const override { return "image"; }
  std::string description() const override {
    return "grey images and label maps: NRRD, NIfTI, MetaImage, a DICOM series folder, TIFF stack";
  }
  int can_open(const std::string& input) const override { return in_memory(input) ? 100 : can_read_scan(input); }
  void declare_options(OptionSet& options) override;
  void expect_cuts(const std::vector<CutPlane>& planes) override { cuts_ = planes; }
  OpenedDomain open(const std::string& input, Progress& progress) override;
  std::vector<InfoSection> info(const std::string& input, Progress& progress) override;

 private:
  /// Null if it is a file.
  const Scan* in_memory(const std::string& input) const;
  /// Its volumes; none if cancelled. Several, or any with --tissue, are probability maps.
  std::vector<Scan> read(const std::string& input, Progress& progress) const;
  std::vector<std::string> files_of(const std::string& input) const;
  NestedLevelSettings settings(const std::vector<double>& levels) const { return {levels, inside_, outside_}; }
  [[noreturn]] void refuse_missing_level(const std::string& input, const Scan& scan) const;
  bool are_maps(const std::vector<Scan>& volumes) const { return volumes.size() > 1 || !tissues_.empty(); }
  /// The input's maps and those of --tissue, and the files; no maps if cancelled.
  TissueMaps read_maps(const std::string& input, std::vector<Scan> volumes, std::vector<std::string>& files,
                       Progress& progress) const;
  /// Why the scan is taken for a label map; nullopt if it is not.
  std::optional<std::string> reason_to_label(const Scan& scan) const;
  void refuse_options_of_levels(const std::string& input, const std::string& reason) const;

  std::shared_ptr<const ScansInMemory> in_memory_;
  std::vector<double> levels_;
  InsideSide inside_ = InsideSide::above;
  std::optional<double> outside_;
  bool as_grey_ = false;
  ComponentOptions components_;
  SimplifyOptions simplify_;
  HandleOption handles_;
  std::vector<std::string> tissues_;  // files of probability maps beside the input
  LabelOptions labels_;
  std::vector<CutPlane> cuts_;
};

const Scan* ImagePlugin::in_memory(const std::string& input) const {
  if (in_memory_ == nullptr) return nullptr;
  const auto found = in_memory_->find(input);
  return found == in_memory_->end() ? nullptr : &found->second;
}

std::vector<Scan> ImagePlugin::read(const std::string& input, Progress& progress) const {
  const Scan* const scan = in_memory(input);
  return scan ? std::vector{*scan} : read_volumes(input, progress, !tissues_.empty());
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
  handles_.declare(options, kGroup);
  options.add(
      "tissue", tissues_,
      {kLabelGroup, "FILE", "a probability map",
       "Another probability map, on the grid of the input: then the input is one, too, and each is a tissue, region 1, "
       "2 and so on in this order. A file may hold several maps, as an image of four dimensions; if the input does, "
       "that is enough. A point belongs to the tissue that is most likely there; the background has what they leave of "
       "1. Values are from 0 to 1, those of 8-bit integers 255ths, or percents if they come to no more than 127, or "
       "masks if none is above 1. --labels chooses among them."});
  labels_.declare(options, kLabelGroup);
}

void ImagePlugin::refuse_missing_level(const std::string& input, const Scan& scan) const {
  const std::string level = "--level " + number_text(suggested_level(scan)) + " (Otsu's threshold)";
  const std::string look =
      in_memory(input) ? ", or look at what info says of the image" : ", or look at scantet info " + input;
  const auto few = few_whole_values(scan);
  throw Error(
      Fault::usage, "usage.level_missing",
      "--level is missing: " + input + " is a grey image with values from " + number_text(scan.min_value) + " to " +
          number_text(scan.max_value) + ", and the surface is where they cross the level",
      few ? "try --labels all if its " + std::to_string(*few) + " whole values name things, else " + level + look
          : "try " + level + look + "; --labels all if its numbers name things");
}

std::optional<std::string> ImagePlugin::reason_to_label(const Scan& scan) const {
  if (as_grey_) {
    if (!labels_.any()) return std::nullopt;
    throw Error(Fault::usage, "usage.labels", "--as-grey: labels are asked for, too", "leave one of the two out");
  }
  return reason_for_labels(scan, labels_);
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
  refuse(handles_.thinner_mm.has_value(), "close-handles");
}

TissueMaps ImagePlugin::read_maps(const std::string& input, std::vector<Scan> volumes, std::vector<std::string>& files,
                                  Progress& progress) const {
  const bool of_levels =
      !levels_.empty() || inside_ != InsideSide::above || outside_ || components_.choice() || handles_.thinner_mm;
  if (of_levels || as_grey_) {
    const std::string asked = "levels, components or grey values are asked for";
    if (!tissues_.empty()) {
      throw Error(Fault::usage, "usage.labels", "--tissue: " + asked + ", too", "leave out one of the two");
    }
    throw Error(Fault::input, "input.dimension",
                "'" + input + "' holds " + std::to_string(volumes.size()) + " volumes, and " + asked,
                "extract one volume, for example with 'fslroi IN OUT 0 1' or 3D Slicer; without these options the "
                "volumes are taken for probability maps");
  }
  labels_.refuse_idle_smoothing(input);
  TissueMaps tissues;
  files = files_of(input);
  std::string file = input;
  for (std::size_t n = 0;; ++n) {
    tissues.add(std::move(volumes), file);
    if (n == tissues_.size()) break;
    file = tissues_[n];
    volumes = read(file, progress);
    if (progress.cancelled()) return {};
    for (const std::string& part : files_of(file)) files.push_back(part);
  }
  tissues.choose(labels_);
  tissues.simplify(simplify_.simplification());
  tissues.go_on_beyond(cuts_);
  return tissues;
}

OpenedDomain ImagePlugin::open(const std::string& input, Progress& progress) {
  const Simplification how = simplify_.simplification();
  std::vector<Scan> volumes = read(input, progress);
  if (progress.cancelled()) return {};
  OpenedDomain opened;
  std::vector<std::string> files;
  const Frame frame = volumes.front().frame;
  if (are_maps(volumes)) {
    const TissueMaps tissues = read_maps(input, std::move(volumes), files, progress);
    if (progress.cancelled()) return {};
    opened = open_tissues(tissues, progress);
  } else {
    const std::optional<std::string> labels = reason_to_label(volumes.front());
    if (labels) refuse_options_of_levels(input, *labels);
    if (!labels) labels_.refuse_idle_smoothing(input);
    const Scan simple = simplified(std::exchange(volumes.front(), {}), how);
    if (!labels && levels_.empty()) refuse_missing_level(input, simple);
    files = files_of(input);
    NestedLevelSettings meshed = settings(levels_);
    opened = labels ? open_labels(simple, input, labels_, cuts_, progress)
                    : open_object(simple, meshed, handles_, components_.choice(), progress);
    levels_ = meshed.levels;  // the report tells what was used
  }
  if (how.is_any()) opened.notes.push_back(simplification_note(how, frame));
  opened.files = files;
  return opened;
}

std::vector<InfoSection> ImagePlugin::info(const std::string& input, Progress& progress) {
  const Simplification how = simplify_.simplification();
  std::vector<Scan> volumes = read(input, progress);
  if (progress.cancelled()) return {};
  if (are_maps(volumes)) {
    std::vector<std::string> files;
    const TissueMaps tissues = read_maps(input, std::move(volumes), files, progress);
    if (progress.cancelled()) return {};
    std::vector<InfoSection> sections{describe_grid(tissues.maps.front()), describe_tissues(tissues, progress)};
    if (how.is_any()) sections.insert(sections.begin(), describe_simplification(how));
    return sections;
  }
  const Scan& given = volumes.front();
  const std::optional<std::string> labels = reason_to_label(given);
  if (labels) refuse_options_of_levels(input, *labels);
  if (!labels) labels_.refuse_idle_smoothing(input);
  const Scan scan = simplified(given, how);
  if (labels) {
    std::vector<InfoSection> sections{describe_grid(scan), describe_labels(scan, *labels, input, labels_, progress)};
    if (progress.cancelled()) return {};
    if (how.is_any()) sections.insert(sections.begin(), describe_simplification(how));
    return sections;
  }
  const ScanStatistics statistics = statistics_of(scan);
  const double suggested = suggested_level(scan);
  std::vector<InfoSection> sections = describe_scan(scan, statistics, suggested);
  if (how.is_any()) sections.insert(sections.begin(), describe_simplification(how));
  const NestedLevelSettings asked =
      settings(levels_.empty() ? std::vector{suggested} : outermost_first(levels_, inside_));
  NestedLevelSettings meshed = asked;
  const std::vector<ValuesAtLevel> at = clear_levels(scan, meshed);
  std::optional<ClosedHandles> closed;
  if (handles_.thinner_mm) closed = without_thin_handles(scan, meshed, *handles_.thinner_mm, progress);
  if (progress.cancelled()) return {};
  const Scan& of = closed ? closed->scan : scan;
  const ScanObject kept = find_object(of, meshed, components_.choice(), progress);
  if (kept.domain == nullptr) return {};
  if (closed) sections.push_back(describe_closed(*closed));
  for (InfoSection& section : describe_levels(of, asked, at, !levels_.empty())) {
    sections.push_back(std::move(section));
  }
  for (InfoSection& section : describe_regions(*kept.domain, meshed.levels.size()))
    sections.push_back(std::move(section));
  if (kept.dropped) {
    sections.push_back(describe_dropped(*kept.dropped, meshed.levels.size()));
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
