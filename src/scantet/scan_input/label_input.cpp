// Names and colours come from the image's header, from MRIcron's file beside it and from --label-names; the latter ones
// overrule the former. What --labels says overrules all.
#include "scantet/scan_input/label_input.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>

#include "scantet/base/error.h"
#include "scantet/labels/label_object.h"

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

/// "keep", "none" (as an option: empty) or the width of a Gaussian, mm.
std::pair<LabelSmoothing, double> read_smoothing(const std::string& place, const std::string& text) {
  if (text == "keep") return {LabelSmoothing::keep, 0};
  if (text.empty() || text == "none") return {LabelSmoothing::none, 0};
  double width = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, width);
  if (code == std::errc{} && stop == end && width > 0 && std::isfinite(width)) return {LabelSmoothing::gaussian, width};
  throw Error(Fault::usage, "usage.value", place + ": " + text + " is no way of smoothing",
              "give keep, none, or the width of a Gaussian in mm");
}

/// What a Gaussian has done to the labels.
std::string note_on_gaussian(const LabelObject& object, const LabelSettings& settings) {
  constexpr std::size_t kMostNamed = 10;
  std::string text = "--label-smoothing " + number_text(settings.gaussian_mm) +
                     " does not keep labels: " + std::to_string(object.changed_voxels) +
                     (object.changed_voxels == 1 ? " voxel centre has" : " voxel centres have") +
                     " another one, also for the audit";
  if (object.lost.empty()) return text + "; no label is lost";
  text += "; lost are";
  for (std::size_t n = 0; n < std::min(object.lost.size(), kMostNamed); ++n) {
    const auto name = settings.names.find(object.lost[n]);
    text += (n == 0 ? " " : ", ") + std::to_string(object.lost[n]);
    if (name != settings.names.end()) text += " (" + name->second + ")";
  }
  if (object.lost.size() > kMostNamed) text += " and " + std::to_string(object.lost.size() - kMostNamed) + " more";
  return text;
}

}  // namespace

void LabelOptions::declare(OptionSet& options) {
  options.add(
      "tissue", tissues,
      {kGroup, "FILE", "a probability map",
       "Another probability map, on the grid of the input: then the input is one, too, and each is a tissue, region 1, "
       "2 "
       "and so on in this order. A point belongs to the tissue that is most likely there; the background has what they "
       "leave of 1. Values are from 0 to 1, those of 8-bit integers 255ths."});
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
      "label-smoothing", smoothing, Range::above(0), "keep or none",
      [](const OptionValue& value) { read_smoothing(value.place, value.text); },
      {kGroup, "HOW", "a way of smoothing",
       "How surfaces run between the voxels of different labels. keep: as smoothly as may be while each voxel's centre "
       "keeps its label and each label its volume, so that nothing that has a voxel is lost; none: halfway between the "
       "voxels, in stairs; a length in mm: a Gaussian of that standard deviation for each label, and the largest wins. "
       "That does not keep labels: thin parts and small ones can vanish, and a note lists those lost.",
       0, "keep"});
}

LabelSettings LabelOptions::settings(const std::string& input, const std::vector<LabelCount>& counts) const {
  const LabelChoice choice = read_label_choice("--labels", labels);
  LabelTable known = names.empty() ? LabelTable() : read_label_table(names);
  known.merge(table_of_segments(input));
  known.merge(table_beside(input));
  LabelSettings settings = settings_of(choice, known, counts);
  const auto [how, gaussian_mm] = read_smoothing("--label-smoothing", smoothing);
  settings.smoothing = how;
  settings.gaussian_mm = gaussian_mm;
  return settings;
}

namespace {

OpenedDomain opened_of(LabelObject&& object, const Scan& scan) {
  OpenedDomain opened;
  opened.domain = std::move(object.domain);
  opened.grid = std::move(object.grid);
  opened.phases = std::move(object.phases);
  opened.frame = scan.frame;
  opened.border = border_planes(scan.frame, scan.size);
  opened.default_size_mm = kVoxelsPerSize * scan.frame.min_spacing_mm();
  opened.default_size_reason = number_text(kVoxelsPerSize) + " x the smallest voxel spacing";
  return opened;
}

}  // namespace

OpenedDomain open_label_scan(const Scan& scan, const LabelSettings& settings, Progress& progress) {
  LabelObject object = make_label_object(scan, settings, progress);
  if (object.domain == nullptr) return {};
  const std::string note = settings.smoothing == LabelSmoothing::gaussian ? note_on_gaussian(object, settings) : "";
  OpenedDomain opened = opened_of(std::move(object), scan);
  opened.colors = settings.colors;
  if (!note.empty()) opened.notes.push_back(note);
  return opened;
}

OpenedDomain open_tissues(const std::vector<Scan>& maps, const std::vector<std::string>& files, Progress& progress) {
  std::map<Region, std::string> names;
  for (std::size_t n = 0; n < files.size(); ++n) {
    const std::string file = std::filesystem::path(files[n]).filename().string();
    names[static_cast<Region>(n + 1)] = file.substr(0, file.find('.'));
  }
  LabelObject object = make_tissue_object(maps, names, progress);
  return object.domain == nullptr ? OpenedDomain() : opened_of(std::move(object), maps.front());
}

OpenedDomain open_labels(const Scan& scan, const std::string& input, const LabelOptions& options, Progress& progress) {
  const std::vector<LabelCount> counts = count_labels(scan);
  const LabelSettings settings = options.settings(input, counts);
  OpenedDomain opened = open_label_scan(scan, settings, progress);
  if (opened.domain == nullptr) return opened;
  const std::string note = note_on_background(counts, settings);
  if (!note.empty()) opened.notes.insert(opened.notes.begin(), note);
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
