// Names and colours come from the image's header, from MRIcron's file beside it and from --label-names; the latter ones
// overrule the former. What --labels says overrules all.
#include "scantet/scan_input/label_input.h"

#include <cmath>
#include <map>

#include "scantet/base/phase_clock.h"
#include "scantet/labels/junctions.h"
#include "scantet/labels/label_domain.h"
#include "scantet/labels/label_grid.h"

namespace scantet {
namespace {

constexpr const char* kGroup = "Label map";
constexpr double kVoxelsPerSize = 2;

std::string note_on_background(const std::vector<LabelCount>& labels, const LabelSettings& settings) {
  std::vector<std::int64_t> values;
  for (const LabelCount& count : labels) values.push_back(count.label);
  const std::vector<Region> regions = regions_of_labels(values, settings);
  std::size_t dropped = 0;
  for (std::size_t n = 0; n < values.size(); ++n) dropped += regions[n] == kOutside && values[n] != settings.background;
  if (dropped == 0) return {};
  return std::to_string(dropped) + (dropped == 1 ? " label is" : " labels are") +
         " not chosen, and part of the background";
}

}  // namespace

void LabelOptions::declare(OptionSet& options) {
  options.add(
      "labels", labels,
      {kGroup, "WHICH", "a choice of labels",
       "Which labels of a label map are meshed, each as a region of its number: all, a list such as 1,3,7-12, "
       "or a table of lines \"label name\" or \"label new_label name\", which names labels and groups them. What "
       "is not chosen belongs to the background, as 0 does. With this, any image of whole numbers is a label "
       "map.",
       0, "all, if the image is a label map"});
  options.add(
      "label-names", names,
      {kGroup, "FILE", "a table of names",
       "The names of labels, which files and reports have for regions: a table of FreeSurfer, ITK-SNAP, BIDS "
       "(dseg.tsv) or MRIcron, or lines \"label name\". Without it, those in the header of a segmentation of 3D "
       "Slicer, or in the .txt that MRIcron keeps beside an image.",
       0, "those that come with the image"});
  options.add(
      "label-smoothing", smoothing, {{"keep", LabelSmoothing::keep}, {"none", LabelSmoothing::none}},
      {kGroup, "HOW", "a way of smoothing",
       "How surfaces run between the voxels of different labels. keep: as smoothly as may be while each voxel's centre "
       "keeps its label and each label its volume, so that nothing that has a voxel is lost; none: halfway between the "
       "voxels, in stairs."});
}

LabelSettings LabelOptions::settings(const std::string& input, const std::vector<LabelCount>& counts) const {
  const LabelChoice choice = read_label_choice("--labels", labels);
  LabelTable known = names.empty() ? LabelTable() : read_label_table(names);
  known.merge(table_of_segments(input));
  known.merge(table_beside(input));
  LabelSettings settings = settings_of(choice, known, counts);
  settings.smoothing = smoothing;
  return settings;
}

OpenedDomain open_labels(const Scan& scan, const std::string& input, const LabelOptions& options, Progress& progress) {
  const std::vector<LabelCount> counts = count_labels(scan);
  LabelSettings settings = options.settings(input, counts);
  OpenedDomain opened;
  const std::shared_ptr<const LabelField> field = make_label_field(scan, settings, progress, &opened.phases);
  if (field == nullptr) return opened;
  if (const std::string note = note_on_background(counts, settings); !note.empty()) opened.notes.push_back(note);
  PhaseClock phase(opened.phases, progress);
  phase.begin("read", "junctions");
  Junctions junctions = find_junctions(*field, progress);
  phase.end();
  if (progress.cancelled()) return {};
  opened.colors = std::move(settings.colors);
  opened.grid = [field] { return region_grid(*field); };
  opened.domain =
      make_label_domain(field, {std::move(settings.names), std::move(junctions.curves), std::move(junctions.corners)});
  opened.frame = scan.frame;
  opened.border = border_planes(scan.frame, scan.size);
  opened.default_size_mm = kVoxelsPerSize * scan.frame.min_spacing_mm();
  opened.default_size_reason = number_text(kVoxelsPerSize) + " x the smallest voxel spacing";
  return opened;
}

InfoSection describe_labels(const Scan& scan, const std::string& reason, const std::string& input,
                            const LabelOptions& options) {
  const std::vector<LabelCount> counts = count_labels(scan);
  const LabelSettings settings = options.settings(input, counts);
  std::vector<std::int64_t> values;
  for (const LabelCount& count : counts) values.push_back(count.label);
  const std::vector<Region> regions = regions_of_labels(values, settings);
  std::map<Region, std::uint64_t> voxels;
  for (std::size_t n = 0; n < values.size(); ++n) voxels[regions[n]] += counts[n].voxels;
  InfoSection section{"labels", "Label map", {}};
  section.entries = {
      {"reason", "it is a label map", reason, ""},
      {"count", "values", static_cast<std::int64_t>(counts.size()), ""},
      {"regions", "regions to mesh", static_cast<std::int64_t>(voxels.size() - voxels.count(kOutside)), ""}};
  const double voxel_mm3 = std::abs(scan.frame.determinant_mm3());
  for (const auto& [region, count] : voxels) {
    const std::string number = std::to_string(region);
    const auto name = settings.names.find(region);
    if (name != settings.names.end())
      section.entries.push_back({"name_" + number, "label " + number, name->second, ""});
    const std::string what = region == kOutside ? "background" : "label " + number;
    section.entries.push_back({"voxels_" + number, what, static_cast<std::int64_t>(count), "voxels"});
    section.entries.push_back({"volume_" + number + "_mm3", what, static_cast<double>(count) * voxel_mm3, "mm^3"});
  }
  return section;
}

}  // namespace scantet
