#include "scantet/app/spent_time.h"

#include <algorithm>

namespace scantet {

void SpentTime::add(const MeshResult& mesh, bool counts) {
  sample_s_ += mesh.sample_s;
  refine_s_ += mesh.refine_s;
  add_stages(mesh.stages, counts);
}

void SpentTime::add(const Meshing& meshing, bool counts) {
  add(meshing.phases);
  add(meshing.refined, counts);
}

void SpentTime::add(const std::vector<PhaseAccount>& phases) {
  for (const PhaseAccount& phase : phases) {
    bounds_.seconds += phase.seconds;
    bounds_.cpu_seconds += phase.cpu_seconds;
  }
}

void SpentTime::add(const SpentTime& other) {
  sample_s_ += other.sample_s_;
  refine_s_ += other.refine_s_;
  add({other.bounds_});
  add_stages(other.stages_, false);
}

void SpentTime::put_into(Meshing& meshing, double all_s) const {
  meshing.refined.sample_s = sample_s_;
  meshing.refined.refine_s = refine_s_;
  meshing.refined.stages = stages_;
  meshing.phases = {bounds_};
  meshing.optimize_s = all_s - sample_s_ - refine_s_ - bounds_.seconds;
}

void SpentTime::add_stages(const std::vector<StageAccount>& parts, bool counts) {
  std::size_t next = 0;  // where a part belongs that is not there yet
  for (const StageAccount& part : parts) {
    const auto is_it = [&](const StageAccount& stage) { return stage.stage == part.stage; };
    auto stage = std::find_if(stages_.begin(), stages_.end(), is_it);
    if (stage == stages_.end()) {
      stage = stages_.insert(stages_.begin() + static_cast<std::ptrdiff_t>(next), {part.stage, 0, part.points});
    }
    stage->seconds += part.seconds;
    if (counts) stage->points = part.points;
    next = static_cast<std::size_t>(stage - stages_.begin()) + 1;
  }
}

}  // namespace scantet
