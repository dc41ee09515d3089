// What the attempts at a mesh took, one after the other.
#pragma once

#include <vector>

#include "scantet/app/meshing.h"

namespace scantet {

/// The time that all attempts took together, stage by stage in the order of the first attempt, which samples.
class SpentTime {
 public:
  /// counts: whether this mesh is the best so far, so that its points are those that are kept.
  void add(const MeshResult& mesh, bool counts);
  void add(const Meshing& meshing, bool counts);
  void add(const std::vector<PhaseAccount>& phases);
  void add(const SpentTime& other);
  /// all_s: what everything took.
  void put_into(Meshing& meshing, double all_s) const;

 private:
  void add_stages(const std::vector<StageAccount>& parts, bool counts);

  double sample_s_ = 0;
  double refine_s_ = 0;
  std::vector<StageAccount> stages_;
  PhaseAccount bounds_{"audit", "bounds", 0, 0};
};

}  // namespace scantet
