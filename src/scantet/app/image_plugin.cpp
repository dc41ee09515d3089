// The level-set opener: reads a scan through ITK and hands the mesher its trilinear level set. What `scantet info` says
// of a scan is put together in image_info.cpp.
#include "scantet/app/image_plugin.h"

#include "scantet/app/image_info.h"
#include "scantet/app/input_files.h"
#include "scantet/base/error.h"
#include "scantet/image/level_set.h"
#include "scantet/image/scan_reader.h"
#include "scantet/image/scan_statistics.h"
#include "scantet/image/suggested_level.h"

namespace scantet {
namespace {

constexpr double kVoxelsPerSize = 2;
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
  LevelSetSettings settings(double level) const { return {level, inside_, outside_}; }
  [[noreturn]] void refuse_missing_level(const std::string& input, const Scan& scan) const;

  std::optional<double> level_;
  InsideSide inside_ = InsideSide::above;
  std::optional<double> outside_;
};

void ImagePlugin::declare_options(OptionSet& options) {
  options.add(
      "level", level_, Range(),
      {kGroup, "V", "a level",
       "Value of the surface, in the units of the voxels. Needed to mesh a grey image; scantet info suggests one.", 0,
       "required to mesh"});
  options.add("inside", inside_, {{"above", InsideSide::above}, {"below", InsideSide::below}},
              {kGroup, "SIDE", "a side", "Which side of the level is the object."});
  options.add(
      "outside", outside_, Range(),
      {kGroup, "V", "a value",
       "Value of the field one voxel beyond the image, on the outside of the level: it closes the surface at the "
       "border.",
       0, "smallest value of the image; largest with --inside below"});
}

void ImagePlugin::refuse_missing_level(const std::string& input, const Scan& scan) const {
  const std::string suggested = number_text(suggested_level(scan));
  throw Error(Fault::usage, "usage.level_missing",
              "--level is missing: " + input + " is a grey image with values from " + number_text(scan.min_value) +
                  " to " + number_text(scan.max_value) + ", and the surface is where they cross the level",
              "try --level " + suggested + " (Otsu's threshold), or look at scantet info " + input);
}

OpenedDomain ImagePlugin::open(const std::string& input, Progress& progress) {
  const Scan scan = read_scan(input, progress);
  if (progress.cancelled()) return {};
  if (!level_) refuse_missing_level(input, scan);
  OpenedDomain opened;
  opened.domain = make_level_set(scan, settings(*level_));
  opened.frame = scan.frame;
  opened.default_size_mm = kVoxelsPerSize * scan.frame.min_spacing_mm();
  opened.default_size_reason = number_text(kVoxelsPerSize) + " x the smallest voxel spacing";
  opened.files = input_files(input);
  return opened;
}

std::vector<InfoSection> ImagePlugin::info(const std::string& input, Progress& progress) {
  const Scan scan = read_scan(input, progress);
  if (progress.cancelled()) return {};
  const ScanStatistics statistics = statistics_of(scan);
  const double suggested = suggested_level(scan);
  std::vector<InfoSection> sections = describe_scan(scan, statistics, suggested);
  const auto domain = make_level_set(scan, settings(level_.value_or(suggested)));
  sections.push_back(describe_border(scan, settings(level_.value_or(suggested)), level_.has_value()));
  sections.push_back(describe_components(*domain));
  return sections;
}

}  // namespace

std::unique_ptr<InputPlugin> make_image_plugin() {
  return std::make_unique<ImagePlugin>();
}

}  // namespace scantet
