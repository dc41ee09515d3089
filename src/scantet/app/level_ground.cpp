#include "scantet/app/level_ground.h"

namespace scantet {
namespace {

bool have_ways_level_ground(const Domain& domain) {
  const auto count = [&](LevelGround ground) {
    std::size_t ways = 0;
    domain.narrow_ways(ground, [&](const NarrowWay&) { ++ways; });
    return ways;
  };
  return count(LevelGround::is_crossed) != count(LevelGround::ends_ways);
}

/// Whether handles are what is wrong: more than the first finer places mend, but not all over, or nothing else.
bool may_help(const Meshing& last, const MeshFaults& faults) {
  return has_several_wrong_handles(last) || has_only_wrong_handles(last, faults);
}

}  // namespace

void LevelGroundTrial::judge(const Meshing& last, const MeshFaults& faults, std::size_t losses, MesherOptions& mesher,
                             std::optional<MeshResult>& start) {
  if (before_ && losses >= before_->losses) {
    mesher.level_ground = LevelGround::ends_ways;
    start = std::move(before_->start);
  }
  before_.reset();
  if (is_over_ || !may_help(last, faults)) return;
  is_over_ = true;
  if (!have_ways_level_ground(domain_)) return;
  before_ = Before{start, losses};
  mesher.level_ground = LevelGround::is_crossed;
  mesher.handle_rounds = handle_rounds_;
}

}  // namespace scantet
