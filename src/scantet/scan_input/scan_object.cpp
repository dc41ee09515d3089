// Without a choice nothing is to be counted, let alone copied: find_object() tells that case apart.
#include "scantet/scan_input/scan_object.h"

#include <algorithm>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/phase_clock.h"
#include "scantet/field/label_map.h"
#include "scantet/scan_input/clear_levels.h"

namespace scantet {
namespace {

constexpr double kVoxelsPerSize = 2;

/// What a least volume leaves as it is: cavities, at least one.
std::string note_on(const SmallCavities& cavities, double min_volume_mm3) {
  constexpr int kDigits = 6;
  return "--min-component " + number_text(min_volume_mm3, kDigits) + " leaves out components, not cavities: " +
         (cavities.count == 1 ? "1 cavity smaller than that stays, of "
                              : std::to_string(cavities.count) + " cavities smaller than that stay, the smallest of ") +
         number_text(cavities.least_mm3, kDigits) + " mm^3";
}

std::string note_on(const FilledCavities& filled, double fill_cavities_mm3) {
  constexpr int kDigits = 6;
  const std::string asked = "--fill-cavities " + number_text(fill_cavities_mm3, kDigits);
  if (filled.count == 0) return asked + ": there is no cavity so small";
  return asked + " fills " + (filled.count == 1 ? "1 cavity, of " : std::to_string(filled.count) + " cavities, of ") +
         number_text(filled.volume_mm3, kDigits) + " mm^3" +
         (filled.count == 1 ? "" : " together, the largest of " + number_text(filled.largest_mm3, kDigits) + " mm^3") +
         (filled.count == 1 ? "; it is" : "; they are") + " not there for the audit either";
}

/// Handles that cannot be compared; empty if all are known. Where components are not known, the report says that.
std::string note_on_handles(const Domain& domain) {
  const std::vector<Component> components = domain.components();
  const auto is_unknown = [](const Component& component) { return !component.euler; };
  const auto unknown = std::count_if(components.begin(), components.end(), is_unknown);
  if (unknown == 0) return {};
  return "how many handles " +
         (unknown == 1 ? std::string("a component or cavity has")
                       : std::to_string(unknown) + " components and cavities have") +
         " is not known, as whole cells of voxels are at the level itself: where the mesh loses one of these handles, "
         "nothing tells; at another --level they are known";
}

}  // namespace

ScanObject find_object(const Scan& scan, const NestedLevelSettings& settings,
                       const std::optional<ComponentChoice>& choice, const Progress& progress) {
  if (!choice) return {make_nested_level_sets(scan, settings, progress), std::nullopt, {}, {}};
  KeptComponents kept = keep_components(scan, settings, *choice, progress);
  KeptLevelSets made = make_kept_level_sets(scan, settings, kept, choice->min_volume_mm3, progress);
  ScanObject object{std::move(made.domain), std::nullopt, made.cavities, kept.filled};
  if (choice->drops()) object.dropped = std::move(kept.dropped);
  return object;
}

OpenedDomain open_object(const Scan& scan, NestedLevelSettings& settings, const HandleOption& handles,
                         const std::optional<ComponentChoice>& choice, Progress& progress) {
  OpenedDomain opened;
  const std::vector<double> asked = settings.levels;
  opened.notes = notes_on_levels(clear_levels(scan, settings), asked);
  Scan closed_scan = scan;
  if (handles.thinner_mm) {
    PhaseClock clock(opened.phases, progress);
    clock.begin("read", "handles");
    ClosedHandles closed = without_thin_handles(scan, settings, *handles.thinner_mm, progress);
    if (progress.cancelled()) return {};
    opened.notes.push_back(closing_note(closed, *handles.thinner_mm));
    closed_scan = std::move(closed.scan);
  }
  ScanObject object = find_object(closed_scan, settings, choice, progress);
  opened.domain = std::move(object.domain);
  opened.dropped = std::move(object.dropped);
  if (object.cavities.count > 0) opened.notes.push_back(note_on(object.cavities, choice->min_volume_mm3));
  if (choice && choice->fill_cavities_mm3 > 0) {
    opened.notes.push_back(note_on(object.filled, choice->fill_cavities_mm3));
  }
  if (opened.domain != nullptr) {  // else it was cancelled
    std::string note = note_on_handles(*opened.domain);
    if (!note.empty()) opened.notes.push_back(std::move(note));
  }
  opened.frame = scan.frame;
  opened.border = border_planes(scan.frame, scan.size);
  opened.default_size_mm = kVoxelsPerSize * scan.frame.min_spacing_mm();
  opened.default_size_reason = number_text(kVoxelsPerSize) + " x the smallest voxel spacing";
  return opened;
}

void refuse_labels(const Scan& scan, const std::string& name, const std::string& remedy) {
  const std::optional<LabelMap> labels = find_labels(scan);
  if (!labels) return;
  throw Error(Fault::input, "input.labels",
              name + " is a label map: " + labels->reason +
                  "; its numbers name things, and where they cross a level is "
                  "no surface of any of them",
              remedy);
}

}  // namespace scantet
