// Opens grids of OpenVDB's files, and turns scans into them.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "backend.h"
#include "dense_grid.h"
#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/image/nested_level_sets.h"
#include "scantet/plugin/plugin.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/scan_input/clear_levels.h"
#include "scantet/scan_input/label_input.h"
#include "vdb_domain.h"

namespace vdb {
namespace {

using scantet::InfoSection;
using scantet::InsideSide;
using scantet::number_text;

constexpr double kVoxelsPerSize = 2;
const char* const kGroup = "OpenVDB grid";

bool is_named_vdb(const std::string& file) {
  return scantet::file_extension(file) == ".vdb";
}

bool begins_as_vdb(const std::string& file) {
  std::string start(4, '\0');
  std::ifstream(file, std::ios::binary).read(start.data(), 4);
  return start == " BDV";
}

std::vector<double> list_of(const scantet::Vec& v) {
  return {v.x, v.y, v.z};
}

class VdbPlugin final : public scantet::InputPlugin {
 public:
  std::string name() const override { return "vdb"; }
  std::string description() const override { return "OpenVDB: level sets, fog volumes and label maps of .vdb files"; }
  int can_open(const std::string& input) const override {
    std::error_code code;
    if (!std::filesystem::is_regular_file(input, code)) return 0;
    return begins_as_vdb(input) ? 100 : is_named_vdb(input) ? 20 : 0;
  }
  void declare_options(scantet::OptionSet& options) override;
  void expect_cuts(const std::vector<scantet::CutPlane>& planes) override { cuts_ = planes; }
  scantet::OpenedDomain open(const std::string& input, scantet::Progress& progress) override;
  std::vector<InfoSection> info(const std::string& input, scantet::Progress& progress) override;
  std::optional<scantet::GridField> field(const std::string& input, scantet::Progress& progress) override;

  int can_convert(const std::string& input, const std::string& output) const override {
    return is_named_vdb(output) ? scantet::can_read_scan(input) : 0;
  }
  void declare_convert_options(scantet::OptionSet& options) override {
    options.add("outside", outside_, scantet::Range(),
                {kGroup, "V", "a value", "Background of the grid: the value of the field beyond the scan.", 0,
                 "smallest value of the scan"});
  }
  bool convert(const std::string& input, const std::string& output, scantet::Progress& progress) override {
    progress.report({"read", {}, 0, std::nullopt, 0});
    const scantet::Scan scan = scantet::read_scan(input, progress);
    return !progress.cancelled() && backend().write_scan(scan, outside_, output, progress);
  }

 private:
  enum class Side { automatic, above, below };

  std::optional<std::string> grid_name() const { return grid_.empty() ? std::nullopt : std::optional(grid_); }
  /// The levels and the side asked for, or the grid's own; nullopt if it has none.
  std::optional<scantet::NestedLevelSettings> settings(const Grid& grid) const;
  /// A label map: a grid of whole numbers of which no level is asked; nullopt if it is none.
  struct Labels {
    scantet::Scan scan;
    std::string reason;
  };
  std::optional<Labels> labels_of(const Grid& grid, const std::string& input) const;
  /// Adds a section of the grid, and of its labels if it is a label map.
  void describe(const std::string& input, const GridHead& head, std::vector<InfoSection>& sections,
                scantet::Progress& progress) const;

  std::string grid_;
  std::vector<double> levels_;
  Side inside_ = Side::automatic;
  scantet::LabelOptions labels_;
  std::vector<scantet::CutPlane> cuts_;
  std::optional<double> outside_;  // of convert()
};

void VdbPlugin::declare_options(scantet::OptionSet& options) {
  options.add("grid", grid_, {kGroup, "NAME", "a name", "Grid of the file.", 0, "the only one of a scalar type"});
  options.add("level", levels_, scantet::Range(),
              {kGroup, "V", "a level",
               "Value of the surface, in the units of the grid. Given several times: regions inside each other, as of "
               "an image.",
               0, "0 for a level set, 0.5 for a mask of yes and no; required for others"});
  options.add("inside", inside_, {{"automatic", Side::automatic}, {"above", Side::above}, {"below", Side::below}},
              {kGroup, "SIDE", "a side",
               "Which side of the level is the object; automatic: below for a level set, above "
               "for others."});
  labels_.declare(options, kGroup, true, false);  // beyond its voxels a grid is 0
}

std::optional<VdbPlugin::Labels> VdbPlugin::labels_of(const Grid& grid, const std::string& input) const {
  if (labels_.any() && !levels_.empty()) {
    throw scantet::Error(scantet::Fault::usage, "usage.labels", "--level: labels are asked for, too",
                         "leave one of the two out");
  }
  const bool has_levels = !levels_.empty() || grid.head.level_set;
  if (has_levels) labels_.refuse_idle_smoothing(input);
  if (has_levels) return std::nullopt;
  std::optional<scantet::Scan> scan;
  if (holds_whole_numbers(grid)) scan = dense_scan(grid, input);
  if (!scan) {
    if (!labels_.any()) return std::nullopt;
    throw scantet::Error(scantet::Fault::input, "input.labels",
                         input + ": grid " + grid.head.name + " (" + grid.head.value_type + ") holds no labels",
                         "labels are the whole numbers of a grid of int32 or int64, at least two of them");
  }
  const std::optional<std::string> reason = scantet::reason_for_labels(*scan, labels_);
  if (!reason) return std::nullopt;
  if (grid.background != 0) {
    throw scantet::Error(scantet::Fault::input, "input.background",
                         input + ": the background of grid " + grid.head.name + " is label " +
                             number_text(grid.background) + ", which has no end",
                         "write the grid with the background 0");
  }
  if (inside_ != Side::automatic) {
    throw scantet::Error(scantet::Fault::usage, "usage.no_effect",
                         "--inside: it does nothing here: " + input + " is a label map: " + *reason,
                         "leave it out, or give a --level");
  }
  return Labels{*std::move(scan), *reason};
}

std::optional<scantet::NestedLevelSettings> VdbPlugin::settings(const Grid& grid) const {
  constexpr double kHalfWay = 0.5;
  if (levels_.empty() && !grid.head.level_set && !grid.head.mask) return std::nullopt;
  scantet::NestedLevelSettings settings;
  settings.levels = levels_.empty() ? std::vector{grid.head.level_set ? 0.0 : kHalfWay} : levels_;
  const bool below = inside_ == Side::automatic ? grid.head.level_set : inside_ == Side::below;
  settings.inside = below ? InsideSide::below : InsideSide::above;
  return settings;
}

scantet::OpenedDomain VdbPlugin::open(const std::string& input, scantet::Progress& progress) {
  const std::optional<Grid> read = backend().read_grid(input, grid_name(), progress);
  if (!read || progress.cancelled()) return {};
  const Grid& grid = *read;
  if (const std::optional<Labels> labels = labels_of(grid, input)) {
    scantet::OpenedDomain opened = scantet::open_labels(labels->scan, input, labels_, cuts_, progress);
    opened.files = {input};
    return opened;
  }
  auto meshed = settings(grid);
  if (!meshed) {
    throw scantet::Error(scantet::Fault::usage, "usage.level_missing",
                         "--level is missing: grid " + grid.head.name + " of " + input +
                             " is no level set, its values run from " + number_text(grid.min_value) + " to " +
                             number_text(grid.max_value) + ", and the surface is where they cross the level",
                         "look at scantet info " + input + "; --labels all if its numbers name things");
  }
  const std::vector<double> asked = meshed->levels;
  const auto look = [&](double level, InsideSide side) { return values_at_level(grid, level, side, progress); };
  const std::vector<scantet::ValuesAtLevel> at = scantet::clear_levels(look, *meshed);
  if (progress.cancelled()) return {};
  levels_ = meshed->levels;  // the report tells what was used
  inside_ = meshed->inside == InsideSide::above ? Side::above : Side::below;
  scantet::OpenedDomain opened;
  opened.notes = scantet::notes_on_levels(at, asked);
  opened.domain = scantet::nest_level_sets(
      *meshed, grid.max_value - grid.min_value,
      [&](const scantet::LevelSetSettings& level) { return make_domain(grid, level, progress); });
  opened.frame = grid.frame;
  const Index size = std::visit([](const auto& values) { return values.size; }, grid.values);
  opened.border = scantet::border_planes(grid.frame, grid.first, {size[0] - 1, size[1] - 1, size[2] - 1});
  opened.default_size_mm = kVoxelsPerSize * grid.frame.min_spacing_mm();
  opened.default_size_reason = number_text(kVoxelsPerSize) + " x the smallest voxel spacing";
  opened.files = {input};
  return opened;
}

std::optional<scantet::GridField> VdbPlugin::field(const std::string& input, scantet::Progress& progress) {
  const std::optional<Grid> grid = backend().read_grid(input, grid_name(), progress);
  if (!grid || progress.cancelled()) return std::nullopt;
  std::optional<scantet::Scan> scan = dense_scan(*grid, input);
  if (!scan) {
    throw scantet::Error(scantet::Fault::input, "input.grid",
                         input + ": grid " + grid->head.name + " is flat, or all its values are equal",
                         "give a grid of two voxels or more along each axis");
  }
  scan->min_value = grid->min_value;  // of the background, too
  scan->max_value = grid->max_value;
  return scantet::GridField{*std::move(scan), grid->background};
}

void VdbPlugin::describe(const std::string& input, const GridHead& head, std::vector<InfoSection>& sections,
                         scantet::Progress& progress) const {
  InfoSection& section =
      sections.emplace_back(InfoSection{head.name.empty() ? "grid" : head.name, "Grid " + head.name, {}});
  section.entries = {{"class", "class", head.grid_class, ""}, {"type", "type", head.value_type, ""}};
  if (!head.supported || !head.affine) {
    section.entries.push_back({"can_be_meshed", "can be meshed", false, ""});
    return;
  }
  const std::optional<Grid> read = backend().read_grid(input, head.name, progress);
  if (!read) return;
  const Grid& grid = *read;
  const Index size = std::visit([](const auto& values) { return values.size; }, grid.values);
  const auto as_numbers = [](const Index& index) { return std::vector<double>(index.begin(), index.end()); };
  const scantet::Frame& frame = grid.frame;
  for (scantet::InfoEntry entry : std::initializer_list<scantet::InfoEntry>{
           {"active_voxels", "active voxels", grid.active_voxels, ""},
           {"memory_bytes", "memory", grid.memory_bytes, "bytes"},
           {"box_origin", "box from index", as_numbers(grid.origin), ""},
           {"size", "size", as_numbers(size), "voxels"},
           {"spacing_mm", "spacing", std::vector<double>{frame.spacing_mm(0), frame.spacing_mm(1), frame.spacing_mm(2)},
            "mm"},
           {"origin_mm", "origin of the box", list_of(frame.origin()), "mm"},
           {"column_i_mm", "step of i", list_of(frame.column(0)), "mm"},
           {"column_j_mm", "step of j", list_of(frame.column(1)), "mm"},
           {"column_k_mm", "step of k", list_of(frame.column(2)), "mm"},
           {"min", "smallest value", grid.min_value, ""},
           {"max", "largest value", grid.max_value, ""},
           {"background", "background", grid.background, ""}}) {
    section.entries.push_back(std::move(entry));
  }
  const std::optional<Labels> labels = labels_of(grid, input);
  if (!labels) return;
  const InfoSection listed = scantet::describe_labels(labels->scan, labels->reason, input, labels_, progress);
  for (const scantet::InfoEntry& entry : listed.entries) section.entries.push_back(entry);
}

std::vector<InfoSection> VdbPlugin::info(const std::string& input, scantet::Progress& progress) {
  std::vector<InfoSection> sections;
  for (const GridHead& head : backend().read_heads(input, progress)) {
    if (!grid_.empty() && head.name != grid_) continue;
    if (progress.cancelled()) return {};
    describe(input, head, sections, progress);
  }
  if (progress.cancelled()) return {};
  if (sections.empty()) backend().read_grid(input, grid_, progress);  // says that there is no grid of that name
  return sections;
}

}  // namespace
}  // namespace vdb

SCANTET_PLUGIN(vdb::VdbPlugin);
