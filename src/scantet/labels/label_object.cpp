#include "scantet/labels/label_object.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scantet/base/parallel.h"
#include "scantet/base/phase_clock.h"
#include "scantet/labels/junctions.h"
#include "scantet/labels/label_domain.h"
#include "scantet/labels/label_grid.h"
#include "scantet/labels/object_of_field.h"
#include "scantet/labels/probability_field.h"

namespace scantet {

namespace {

/// The junctions of a field, and the field that they are of: where curves cross, a little is changed.
Junctions part_junctions(std::shared_ptr<const LabelField>& field, Progress& progress) {
  constexpr int kRounds = 3;
  Junctions junctions = find_junctions(*field, progress);
  for (int round = 0; round < kRounds && !junctions.crossings.empty(); ++round) {
    std::shared_ptr<const LabelField> parted = part_crossings(*field, junctions.crossings);
    if (parted == nullptr || progress.cancelled()) break;
    field = std::move(parted);
    junctions = find_junctions(*field, progress);
  }
  return junctions;
}

/// What settling does not change.
struct Settled {
  std::map<Region, std::string> names;
  Junctions junctions;
  std::shared_ptr<const LabelField> field;  // that these are of
};

using Settle = decltype(LabelObject::settle);

/// How many voxels each of the field's regions has too much of; empty if none has much.
std::vector<double> excess_of(const LabelField& field, const std::map<Region, double>& volumes_mm3) {
  constexpr double kMuch = 0.0025;  // of its volume
  constexpr double kMuchVoxels = 3;
  const double voxel_mm3 = std::abs(field.frame().determinant_mm3());
  std::vector<double> excess(field.regions().size());
  bool is_much = false;
  for (std::size_t n = 1; n < excess.size(); ++n) {
    const auto volume = volumes_mm3.find(field.regions()[n]);
    if (volume == volumes_mm3.end()) continue;
    const auto voxels = static_cast<double>(field.voxels()[n]);
    excess[n] = volume->second / voxel_mm3 - voxels;
    is_much = is_much || std::abs(excess[n]) > std::max(kMuchVoxels, kMuch * voxels);
  }
  return is_much ? excess : std::vector<double>();
}

/// LabelObject::settle, of a field.
Settle settling(std::shared_ptr<const LabelField> field, std::shared_ptr<const Settled> rest) {
  return [field = std::move(field), rest = std::move(rest)](const std::map<Region, double>& volumes_mm3,
                                                            std::span<const Point> held, Progress& progress) {
    LabelObject object;
    const std::vector<double> excess = excess_of(*field, volumes_mm3);
    if (excess.empty()) return object;
    std::shared_ptr<const LabelField> settled;
    if (!run_interruptible(progress, [&] { settled = field->settled(excess, held); })) return object;
    object.grid = [settled] { return region_grid(*settled); };
    object.domain =
        make_label_domain(settled, {rest->names, rest->junctions.curves, rest->junctions.corners, rest->field});
    object.settle = settling(settled, rest);
    return object;
  };
}

}  // namespace

LabelObject label_object_of(std::shared_ptr<const LabelField> field, const std::map<Region, std::string>& names,
                            LabelAccount account, Progress& progress, Tracing tracing) {
  LabelObject object;
  if (field == nullptr) return object;
  const std::shared_ptr<const LabelField> asked = field;
  const bool is_traced = tracing == Tracing::now || !asked->can_be_fitted();
  Junctions junctions;
  if (is_traced) {
    PhaseClock phase(account.phases, progress);
    phase.begin("read", "junctions");
    junctions = part_junctions(field, progress);
    phase.end();
  }
  if (progress.cancelled()) return object;
  object.grid = [field] { return region_grid(*field); };
  if (asked->can_be_fitted()) {
    object.fit = [field = asked, names](const FacetSizes& facets, Progress& of_fit) {
      LabelAccount fitting;
      PhaseClock clock(fitting.phases, of_fit);
      clock.begin("read", "volumes of labels");
      std::shared_ptr<const LabelField> fitted;
      if (!run_interruptible(of_fit, [&] { fitted = field->fitted_to(facets); })) return LabelObject();
      clock.end();
      return label_object_of(fitted, names, std::move(fitting), of_fit);
    };
  }
  object.phases = std::move(account.phases);
  object.changed_voxels = account.changed;
  object.lost = std::move(account.lost);
  if (asked->is_fitted()) {
    object.settle = settling(field, std::make_shared<const Settled>(Settled{names, junctions, field}));
  }
  LabelDomainParts parts{names, std::move(junctions.curves), std::move(junctions.corners)};
  if (!is_traced) {
    parts.trace = [field] {
      Progress unwatched;
      return find_junctions(*field, unwatched);
    };
  }
  object.domain = make_label_domain(field, std::move(parts));
  return object;
}

LabelObject make_label_object(const Scan& scan, const LabelSettings& settings, Progress& progress) {
  return make_label_object(scan, settings, progress, Tracing::now);
}

LabelObject make_label_object(const Scan& scan, const LabelSettings& settings, Progress& progress, Tracing tracing) {
  LabelAccount account;
  const std::shared_ptr<const LabelField> field = make_label_field(scan, settings, progress, &account);
  return label_object_of(field, settings.names, std::move(account), progress, tracing);
}

LabelObject make_tissue_object(std::span<const Scan> maps, const std::map<Region, std::string>& names,
                               Progress& progress) {
  LabelAccount account;
  const std::shared_ptr<const LabelField> field = make_probability_field(maps, progress);
  if (field != nullptr) account.lost = regions_without_voxels(*field);
  return label_object_of(field, names, std::move(account), progress);
}

}  // namespace scantet
