// Several levels would each change voxels that the others have, too: one is asked for.
#include "scantet/scan_input/handle_option.h"

#include <algorithm>

#include "scantet/base/error.h"

namespace scantet {
namespace {

std::string counted(std::size_t count, const std::string& one) {
  return number_text(static_cast<double>(count)) + " " + one + (count == 1 ? "" : "s");
}

double longest_side_mm(const Scan& scan) {
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, scan.size[axis] * scan.frame.spacing_mm(axis));
  return longest;
}

}  // namespace

void HandleOption::declare(OptionSet& options, const std::string& group) {
  options.add("close-handles", thinner_mm, Range::above(0),
              {group, "MM", "a width in mm",
               "Then handles of the object that are thinner than this are cut, and tunnels through it that are "
               "narrower are filled, whichever changes less: values of single voxels are mirrored at the level. "
               "Components and cavities stay as they are. For grey images and one level; scantet info says how many "
               "handles there are.",
               0, "handles stay"});
}

ClosedHandles without_thin_handles(const Scan& scan, const NestedLevelSettings& settings, double thinner_mm,
                                   const Progress& progress) {
  const std::string option = "--close-handles " + number_text(thinner_mm);
  if (settings.levels.size() != 1) {
    throw Error(Fault::usage, "usage.close_handles",
                option + ": there are " + std::to_string(settings.levels.size()) + " levels, and it is for one",
                "leave it out, or mesh one level");
  }
  const double longest_mm = longest_side_mm(scan);
  if (!(thinner_mm < longest_mm)) {
    throw Error(Fault::usage, "usage.close_handles",
                option + ": the image is only " + number_text(longest_mm) + " mm long",
                "one to three voxels take most handles of noise away: here " +
                    number_text(scan.frame.min_spacing_mm()) + " mm or a few times that");
  }
  const LevelSetSettings level =
      checked_settings(scan, LevelSetSettings{settings.levels.front(), settings.inside, settings.outside});
  return close_handles(scan, level, thinner_mm, progress);
}

std::string closing_note(const ClosedHandles& closed, double thinner_mm) {
  const std::string option = "--close-handles " + number_text(thinner_mm);
  if (!closed.had) {
    return option +
           ": nothing is changed, for the handles cannot be counted: too many voxels are at the level itself; "
           "a level between their values can do";
  }
  std::string note = option;
  if (closed.voxels == 0) {
    note += closed.had == 0 ? ": there is no handle" : ": there is no handle so thin that could be closed";
  } else {
    note += " leaves " + std::to_string(closed.left) + " of " + std::to_string(*closed.had) +
            " handles: " + counted(closed.cut, "cut") + " and " + counted(closed.filled, "filling") + " change " +
            counted(closed.voxels, "voxel") + ", also for the audit: there the image is not as it was read";
  }
  if (closed.wide > 0) {
    note += "; at " + counted(closed.wide, "place") + " the object or a tunnel is as thin, but would take a wider cut";
  }
  if (closed.only_fills) {
    note += "; nothing is cut, as no value is on the outside of the level: choose one between two values for that";
  }
  return note;
}

InfoSection describe_closed(const ClosedHandles& closed) {
  InfoSection section{"closed_handles", "Handles closed before all that follows", {}};
  const auto add = [&](const std::string& key, const std::string& label, std::size_t count) {
    section.entries.push_back({key, label, static_cast<std::int64_t>(count), ""});
  };
  if (!closed.had) {
    section.entries.push_back({"unknown", "handles cannot be counted", true, ""});
    return section;
  }
  section.entries.push_back({"before", "handles before", *closed.had, ""});
  section.entries.push_back({"after", "handles after", closed.left, ""});
  add("cuts", "handles cut", closed.cut);
  add("fillings", "tunnels filled", closed.filled);
  add("voxels", "voxels changed", closed.voxels);
  add("wide", "places as thin that would take a wider cut", closed.wide);
  return section;
}

}  // namespace scantet
