// The settings are checked, and each voxel type gets a voxel field; trilinear_domain.h answers the queries.
#include "scantet/image/level_set.h"

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/field/voxel_field.h"
#include "scantet/image/trilinear_domain.h"

namespace scantet {
/// A value beyond the image that is strictly on the outside closes the surface within the padding. A value equal to the
/// level (the default at a level equal to the smallest value) is moved off it by 0.1 % of the range. A value more than
/// 1000 ranges off the level is refused: it would make the field so steep that a crossing cannot be told to 1e-9 of the
/// range.
LevelSetSettings checked_settings(const Scan& scan, LevelSetSettings settings) {
  check_level(scan.min_value, scan.max_value, settings);
  constexpr double kNudge = 1e-3;
  constexpr double kSteepest = 1e3;
  const bool above = settings.inside == InsideSide::above;
  const double away = above ? -1 : 1;
  const double range = scan.max_value - scan.min_value;
  const double outside = settings.outside.value_or(above ? scan.min_value : scan.max_value);
  const double distance = away * (outside - settings.level);
  if (!(distance >= 0 && distance <= kSteepest * range)) {
    const double limit = settings.level + away * kSteepest * range;
    const char* fault = distance < 0 ? " is on the inside of level " : " is too far off level ";
    throw Error(Fault::usage, "usage.outside",
                "the outside value " + number_text(outside) + fault + number_text(settings.level) + " (inside is " +
                    name_of(settings.inside) + ")",
                "choose a value between " + number_text(std::min(settings.level, limit)) + " and " +
                    number_text(std::max(settings.level, limit)));
  }
  settings.outside = distance > 0 ? outside : settings.level + away * kNudge * range;
  return settings;
}

std::unique_ptr<Domain> make_level_set(const Scan& scan, const LevelSetSettings& settings, const Progress& progress) {
  const LevelSetSettings checked = checked_settings(scan, settings);
  auto domain = std::visit(
      [&]<class Voxel>(const Voxel* voxels) -> std::unique_ptr<Domain> {
        return std::make_unique<TrilinearDomain<VoxelField<Voxel>>>(
            scan.frame, scan.max_value - scan.min_value, VoxelField<Voxel>(scan, checked, voxels),
            [&](const VoxelField<Voxel>&) { return LevelTopology(scan, checked, progress); });
      },
      scan.voxels);
  if (progress.cancelled()) domain.reset();
  return domain;
}

}  // namespace scantet
