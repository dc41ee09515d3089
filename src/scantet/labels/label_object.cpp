#include "scantet/labels/label_object.h"

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

}  // namespace

LabelObject label_object_of(std::shared_ptr<const LabelField> field, const std::map<Region, std::string>& names,
                            LabelAccount account, Progress& progress, const char* phase_name) {
  LabelObject object;
  if (field == nullptr) return object;
  const std::shared_ptr<const LabelField> asked = field;
  PhaseClock phase(account.phases, progress);
  phase.begin("read", phase_name);
  Junctions junctions = part_junctions(field, progress);
  phase.end();
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
      return label_object_of(fitted, names, std::move(fitting), of_fit, "junctions anew");
    };
  }
  object.phases = std::move(account.phases);
  object.changed_voxels = account.changed;
  object.lost = std::move(account.lost);
  object.domain = make_label_domain(field, {names, std::move(junctions.curves), std::move(junctions.corners)});
  return object;
}

LabelObject make_label_object(const Scan& scan, const LabelSettings& settings, Progress& progress) {
  LabelAccount account;
  const std::shared_ptr<const LabelField> field = make_label_field(scan, settings, progress, &account);
  return label_object_of(field, settings.names, std::move(account), progress);
}

LabelObject make_tissue_object(std::span<const Scan> maps, const std::map<Region, std::string>& names,
                               Progress& progress) {
  LabelAccount account;
  const std::shared_ptr<const LabelField> field = make_probability_field(maps, progress);
  if (field != nullptr) account.lost = regions_without_voxels(*field);
  return label_object_of(field, names, std::move(account), progress);
}

}  // namespace scantet
