// Texts are checked when they are set, so that choice() reads valid ones.
#include "scantet/scan_input/component_options.h"

#include <charconv>
#include <cmath>

#include "scantet/base/error.h"

namespace scantet {
namespace {

constexpr double kMostComponents = 9007199254740992.0;  // 2^53: more than an image has voxels

/// How many components a valid text keeps; nullopt: all.
std::optional<std::uint64_t> count_in(const std::string& text) {
  if (text.empty() || text == "all") return std::nullopt;
  if (text == "largest") return 1;
  double count = 0;
  std::from_chars(text.data(), text.data() + text.size(), count);
  return static_cast<std::uint64_t>(std::min(count, kMostComponents));
}

void check_components(const OptionValue& value) {
  if (value.text == "all" || value.text == "largest") return;
  double count = 0;
  const char* const end = value.text.data() + value.text.size();
  const auto [stop, code] = std::from_chars(value.text.data(), end, count);
  const bool is_number = code == std::errc{} && stop == end;
  if (is_number && std::floor(count) == count) return;
  const auto meant = closest_name(value.text, {"all", "largest"});
  throw Error(Fault::usage, "usage.value",
              value.place + ": " + (is_number ? value.text : "\"" + value.text + "\"") +
                  " is not a number of components: it must be a whole number from 1, all or largest" +
                  (meant ? " (did you mean " + *meant + "?)" : ""),
              "--components 3 keeps the three largest");
}

}  // namespace

void ComponentOptions::declare(OptionSet& options, const std::string& group) {
  options.add("components", components, Range::at_least(1), "all or largest", check_components,
              {group, "N", "a number of components",
               "Which components of the object are meshed: all, largest, or the N largest. Their volume is counted: "
               "voxels on the inside of the level times the volume of a voxel. Of several levels this holds for the "
               "inside of each: an island of region 2 that is left out becomes part of region 1, and what further "
               "levels have in a component goes with it.",
               0, "all"});
  options.add("min-component", min_volume_mm3, Range::above(0),
              {group, "MM3", "a volume in mm^3",
               "Components of less than this volume, counted as for --components, are left out. With both options "
               "both hold. Cavities stay, however small, without --fill-cavities: a note says how many are below this "
               "volume."});
  options.add("fill-cavities", fill_cavities_mm3, Range::above(0),
              {group, "MM3", "a volume in mm^3",
               "Cavities of less than this volume, counted as for --components, are filled, with all that is in them, "
               "after components have been left out. Of several levels this holds for the inside of each: an island "
               "of region 1 in region 2 becomes part of region 2.",
               0, "cavities stay"});
}

std::optional<ComponentChoice> ComponentOptions::choice() const {
  const ComponentChoice choice{count_in(components), min_volume_mm3.value_or(0), fill_cavities_mm3.value_or(0)};
  if (!choice.drops() && choice.fill_cavities_mm3 == 0) return std::nullopt;
  return choice;
}

}  // namespace scantet
