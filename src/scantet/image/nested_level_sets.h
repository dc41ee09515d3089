// Several level sets of one scan as one domain: regions inside each other.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/image/level_set.h"

namespace SCANTET_API scantet {

inline constexpr std::size_t kMostLevels = 16;  ///< of one domain

/// Which level sets, and how they close at the border of the image; as LevelSetSettings.
struct NestedLevelSettings {
  std::vector<double> levels;             ///< 1 to kMostLevels, in any order
  InsideSide inside = InsideSide::above;  ///< of every level
  std::optional<double> outside{};        ///< on the outside of every level, or at the outermost
};

/// The levels in the order of their regions: ascending if the inside is above them, else descending.
std::vector<double> outermost_first(std::vector<double> levels, InsideSide inside);

/// The trilinear interpolant f of the scan cut at several levels. With InsideSide::above and l1 < l2 < …, region 1 is
/// l1 < f ≤ l2, region 2 is l2 < f ≤ l3, and so on, the last one without an upper bound; with InsideSide::below the
/// levels count from the highest down. Of one level: what make_level_set() makes.
///
/// The boundary between two neighbouring regions is the level set of one level: a constraint in the sense of the paper
/// (section 9), both sides of which are meshed. Level sets of different levels have no point in common, so no three
/// regions meet.
/// scan: as of make_level_set(). Return: null if progress.cancelled() became true.
/// Throws Error: input.level, usage.outside (what make_level_set() throws for one of the levels, naming it);
/// usage.level (none, too many, or two nearer to each other than 1e-6 of the scan's value range). Guarantees: those of
/// make_level_set() for each level, its memory included; region_at and crossings agree on every segment, whatever
/// rounding does; a segment's crossings change the region one step at a time. components() lists every component of
/// every region, exactly, and the cavities in region 1 that are outside; a component so thin that no double lies in it
/// is left out, and so is one without volume.
std::unique_ptr<Domain> make_nested_level_sets(const Scan& scan, const NestedLevelSettings& settings,
                                               const Progress& progress = Progress());

/// The settings that make_nested_level_sets() works with: the levels as they are, and the outside value strictly on the
/// outside of the outermost. Throws Error: as make_nested_level_sets().
NestedLevelSettings checked_settings(const Scan& scan, NestedLevelSettings settings);

/// What makes the level set of one level of a field, a TrilinearDomain; gives null if cancelled.
using MakeLevelSet = std::function<std::unique_ptr<Domain>(const LevelSetSettings&)>;

/// The same of any trilinear field, with settings.outside as it is. value_range: of the field, > 0. make: is called for
/// one level after the other, the outermost first. Return: null if `make` gave null. Throws Error: usage.level (as
/// make_nested_level_sets()), and what `make` throws.
std::unique_ptr<Domain> nest_level_sets(const NestedLevelSettings& settings, double value_range,
                                        const MakeLevelSet& make);

}  // namespace scantet
