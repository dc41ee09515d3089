// Whether narrow ways across level ground of the domain help the attempts at a mesh.
#pragma once

#include <cstddef>
#include <optional>

#include "scantet/app/mesh_faults.h"
#include "scantet/domain/domain.h"
#include "scantet/refine/mesh_result.h"
#include "scantet/refine/mesher_options.h"

namespace scantet {

/// Where handles are lost, one attempt has ways that lead on across level ground, and those after it have them,
/// too, if it has lost less; else they go on as if it had not been. Of a domain whose ways do not end on level ground
/// nothing changes.
class LevelGroundTrial {
 public:
  /// handle_rounds: of the attempt that has the ways first.
  LevelGroundTrial(const Domain& domain, int handle_rounds) : domain_(domain), handle_rounds_(handle_rounds) {}

  /// After each attempt but the last. mesher: of the next one. start: the points that it goes on from.
  void judge(const Meshing& last, const MeshFaults& faults, std::size_t losses, MesherOptions& mesher,
             std::optional<MeshResult>& start);

  /// Whether the next attempt is the one that has the ways first.
  bool is_next() const { return before_.has_value(); }

 private:
  struct Before {
    std::optional<MeshResult> start;
    std::size_t losses;
  };

  const Domain& domain_;
  int handle_rounds_;
  bool is_over_ = false;
  std::optional<Before> before_;  // the trial
};

}  // namespace scantet
