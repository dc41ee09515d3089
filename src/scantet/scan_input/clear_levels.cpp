#include "scantet/scan_input/clear_levels.h"

#include "scantet/base/options.h"

namespace scantet {
namespace {

std::string note_on_gaps(const ValuesAtLevel& at, double level) {
  return "the level " + number_text(level) + " is itself the value of " + std::to_string(at.voxels) +
         (at.voxels == 1 ? " voxel" : " voxels") + ", " + std::to_string(at.gaps) +
         " of which part the inside: gaps without width, which no mesh can show; at --level " +
         number_text(at.clear_level) + " every voxel is on the same side, and none is at the level";
}

std::string note_on_saddles(const ValuesAtLevel& at, double level) {
  return "the level " + number_text(level) + " is itself the value of " + std::to_string(at.saddles) +
         (at.saddles == 1 ? " saddle" : " saddles") +
         " between voxels, where the level set touches itself at a point, which no mesh can show: " +
         number_text(at.clear_level) + " was taken, for which every voxel is on the same side";
}

}  // namespace

std::vector<ValuesAtLevel> clear_levels(const LevelLook& look, NestedLevelSettings& settings) {
  std::vector<ValuesAtLevel> found;
  for (double& level : settings.levels) {
    found.push_back(look(level, settings.inside));
    if (found.back().voxels == 0) level = found.back().clear_level;
  }
  return found;
}

std::vector<ValuesAtLevel> clear_levels(const Scan& scan, NestedLevelSettings& settings) {
  return clear_levels([&](double level, InsideSide side) { return values_at_level(scan, level, side); }, settings);
}

std::vector<std::string> notes_on_levels(const std::vector<ValuesAtLevel>& at, const std::vector<double>& asked) {
  std::vector<std::string> notes;
  for (std::size_t n = 0; n < at.size(); ++n) {
    if (at[n].gaps > 0) notes.push_back(note_on_gaps(at[n], asked[n]));
    if (at[n].voxels == 0 && at[n].saddles > 0) notes.push_back(note_on_saddles(at[n], asked[n]));
  }
  return notes;
}

}  // namespace scantet
