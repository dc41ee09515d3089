// Names and colours come from the image's header, from MRIcron's file beside it and from --label-names; the latter ones
// overrule the former. What --labels says overrules all.
#include "scantet/scan_input/label_input.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>

#include "scantet/base/error.h"
#include "scantet/base/name_list.h"
#include "scantet/cuts/continued_scan.h"
#include "scantet/cuts/cut_domain.h"
#include "scantet/field/label_map.h"
#include "scantet/labels/label_field.h"
#include "scantet/labels/label_grid.h"
#include "scantet/labels/label_names.h"
#include "scantet/labels/object_of_field.h"
#include "scantet/scan_input/label_object_input_impl.h"

namespace scantet {
namespace {

std::string note_on_background(const std::vector<LabelCount>& labels, const LabelSettings& settings) {
  const std::vector<std::int64_t> values = labels_of(labels);
  const std::vector<Region> regions = regions_of_labels(values, settings);
  std::size_t dropped = 0;
  for (std::size_t n = 0; n < values.size(); ++n) dropped += regions[n] == kOutside && values[n] != settings.background;
  if (dropped == 0) return {};
  return note_on_dropped(dropped, "label");
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
  std::vector<std::string> lost;
  for (const auto label : object.lost) {
    const auto name = settings.names.find(label);
    lost.push_back(std::to_string(label) + (name == settings.names.end() ? "" : " (" + name->second + ")"));
  }
  return text + "; lost are " + name_list(lost, kMostNamed);
}

/// What becomes of 0 where the background is another label; empty if there is no 0.
std::string note_on_zero(const std::vector<LabelCount>& labels, const LabelSettings& settings) {
  if (settings.background == 0 || labels.empty() || labels.front().label != 0) return {};
  return "--background " + std::to_string(settings.background) + ": the label 0 is region " +
         std::to_string(regions_of_labels(labels_of(labels), settings).front());
}

constexpr std::size_t kMostSegmentsNamed = 10;

/// As its header calls it, if it does.
std::string name_of(const ScanSegment& segment) {
  return segment.name.empty() ? "segment " + std::to_string(segment.label) : segment.name;
}

bool is_hidden(const ScanSegment& segment) {
  return segment.voxels > 0 && segment.covered == segment.voxels;
}

/// Segments that others cover wholly.
std::vector<std::string> hidden_segments(const Scan& scan) {
  std::vector<std::string> names;
  for (const ScanSegment& segment : scan.segments) {
    if (is_hidden(segment)) names.push_back(name_of(segment));
  }
  return names;
}

/// What overlaps, and which segments lose a part by it or all.
std::vector<std::string> notes_on_overlap(const Scan& scan) {
  std::vector<std::string> smaller;
  for (const ScanSegment& segment : scan.segments) {
    if (segment.covered == 0 || is_hidden(segment)) continue;
    smaller.push_back(name_of(segment) + " loses " + std::to_string(segment.covered) + " of " +
                      std::to_string(segment.voxels));
  }
  std::vector<std::string> notes{std::to_string(scan.overlapping) +
                                 (scan.overlapping == 1 ? " voxel is" : " voxels are") +
                                 " in several segments, and taken for the last of these"};
  if (!smaller.empty()) notes.front() += ": " + name_list(smaller, kMostSegmentsNamed);
  if (const std::vector<std::string> hidden = hidden_segments(scan); !hidden.empty()) {
    notes.push_back("nothing is left of " + name_list(hidden, kMostSegmentsNamed) + ": later segments cover " +
                    (hidden.size() == 1 ? "it" : "them"));
  }
  return notes;
}

}  // namespace

LabelSettings label_settings(const Scan& scan, const std::string& input, const std::vector<LabelCount>& counts,
                             const LabelOptions& options) {
  LabelTable known = table_of_segments(scan.segments);
  known.merge(table_beside(input));
  LabelSettings settings = chosen_labels(options, std::move(known), counts);
  const auto [how, gaussian_mm] = read_smoothing("--label-smoothing", options.smoothing);
  settings.smoothing = how;
  settings.gaussian_mm = gaussian_mm;
  return settings;
}

void LabelOptions::refuse_idle_smoothing(const std::string& input) const {
  if (smoothing == "keep") return;
  throw Error(Fault::usage, "usage.no_effect", "--label-smoothing: it does nothing here: " + input + " is no label map",
              "leave it out; --smooth is for grey values, and --labels all makes whole numbers a label map");
}

std::vector<std::string> LabelOptions::files(const std::string& image) const {
  std::vector<std::string> files = tables_beside(image);
  if (is_label_table(labels)) files.push_back(labels);
  files.push_back(names);
  std::erase_if(files, [](const std::string& file) {
    std::error_code failure;
    return !std::filesystem::exists(file, failure);
  });
  return files;
}

void LabelOptions::declare(OptionSet& options, const std::string& group, bool has_names, bool has_background) {
  options.add(
      "labels", labels,
      {group, "WHICH", "a choice of labels",
       "Which labels of a label map are meshed, each as a region of its number: all, a list such as 1,3,7-12, "
       "or a table of lines \"label name\" or \"label new_label name\", which names labels and groups them. What "
       "is not chosen belongs to the background, as 0 does. With this, any image of whole numbers is a label "
       "map. Tissues of probability maps are labels from 1 on. Labels that lie inside each other look like grey "
       "values, and need it.",
       0, "all, if the image is a label map"});
  if (has_background) {
    options.add(
        "background", background, Range::between(0, std::numeric_limits<Region>::max()),
        {group, "LABEL", "a label",
         "The label of what is not meshed, where that is not 0. Then 0 is a label as any other; as no region is 0, its "
         "region has the number after the largest, which a note tells. Only without a choice of labels, as what is not "
         "chosen is background, too.",
         0, "0"});
  }
  if (has_names) {
    options.add(
        "label-names", names,
        {group, "FILE", "a table of names",
         "The names of labels, which files and reports have for regions: a table of FreeSurfer, ITK-SNAP, BIDS "
         "(dseg.tsv) or MRIcron, or lines \"label name\". Without it, those in the header of a segmentation of 3D "
         "Slicer, or in the .txt that MRIcron keeps beside an image.",
         0, "those that come with the image"});
  }
  options.add(
      "label-smoothing", smoothing, Range::above(0), "keep or none",
      [](const OptionValue& value) { read_smoothing(value.place, value.text); },
      {group, "HOW", "a way of smoothing",
       "How surfaces run between the voxels of different labels. keep: as smoothly as may be while each voxel's centre "
       "keeps its label and each label its volume, so that nothing that has a voxel is lost; none: halfway between the "
       "voxels, in stairs; a length in mm: a Gaussian of that standard deviation for each label, and the largest wins. "
       "That does not keep labels: thin parts and small ones can vanish, and a note lists those lost.",
       0, "keep"});
}

std::optional<std::string> reason_for_labels(const Scan& scan, const LabelOptions& options) {
  if (const auto found = find_labels(scan)) return found->reason;
  std::string given;
  const auto add = [&](bool is_given, const std::string& option) {
    if (is_given) given += (given.empty() ? "--" : " and --") + option;
  };
  add(!options.labels.empty(), "labels");
  add(options.background != 0, "background");
  add(!options.names.empty(), "label-names");
  if (given.empty()) return std::nullopt;
  return given + (given.find(' ') == std::string::npos ? " says so" : " say so");
}

OpenedDomain open_label_scan(const Scan& scan, const LabelSettings& settings, const std::vector<CutPlane>& cuts,
                             Progress& progress) {
  const Scan continued = continued_beyond(scan, cuts);
  const auto label = static_cast<std::int64_t>(continued.min_value);
  const bool is_one_label = continued.min_value == continued.max_value;
  if (is_one_label && regions_of_labels({label}, settings).front() == kOutside) refuse_cuts();
  LabelObject object = make_label_object(continued, settings, progress, Tracing::when_asked);
  if (object.domain == nullptr) return {};
  const std::string note = settings.smoothing == LabelSmoothing::gaussian ? note_on_gaussian(object, settings) : "";
  OpenedDomain opened = opened_of(std::move(object), scan);
  opened.colors = settings.colors;
  if (!note.empty()) opened.notes.push_back(note);
  return opened;
}

OpenedDomain open_labels(const Scan& scan, const std::string& input, const LabelOptions& options,
                         const std::vector<CutPlane>& cuts, Progress& progress) {
  const std::vector<LabelCount> counts = count_labels(scan);
  const LabelSettings settings = label_settings(scan, input, counts, options);
  OpenedDomain opened = open_label_scan(scan, settings, cuts, progress);
  if (opened.domain == nullptr) return opened;
  const std::string note = note_on_background(counts, settings);
  if (!note.empty()) opened.notes.insert(opened.notes.begin(), note);
  const std::string zero = note_on_zero(counts, settings);
  if (!zero.empty()) opened.notes.push_back(zero);
  if (scan.overlapping == 0) return opened;
  for (std::string& overlap : notes_on_overlap(scan)) opened.notes.push_back(std::move(overlap));
  return opened;
}

InfoSection describe_labels(const Scan& scan, const std::string& reason, const std::string& input,
                            const LabelOptions& options, Progress& progress) {
  const std::vector<LabelCount> counts = count_labels(scan);
  LabelSettings settings = label_settings(scan, input, counts, options);
  settings.smoothing = LabelSmoothing::none;  // voxels are looked at, not the surfaces between them
  const std::shared_ptr<const LabelField> field = make_label_field(scan, settings, progress);
  if (field == nullptr) return {};
  const RegionGrid grid = grid_of_voxels(*field);
  InfoSection section{"labels", "Label map", {}};
  section.entries = {{"reason", "it is a label map", reason, ""},
                     {"count", "values", static_cast<std::int64_t>(counts.size()), ""},
                     {"regions", "regions to mesh", static_cast<std::int64_t>(grid.regions.size()), ""}};
  if (scan.overlapping > 0) {
    section.entries.push_back({"overlapping", "in several segments, taken for the last of them",
                               static_cast<std::int64_t>(scan.overlapping), "voxels"});
  }
  if (const std::vector<std::string> hidden = hidden_segments(scan); !hidden.empty()) {
    section.entries.push_back(
        {"hidden", "nothing is left, under later segments, of", name_list(hidden, kMostSegmentsNamed), ""});
  }
  add_regions(grid, settings.names, "label", section);
  return section;
}

}  // namespace scantet
