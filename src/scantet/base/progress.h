// Progress and cancellation go through one object; the default does nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// Where a long computation stands. Its texts live as long as the call of Progress::report().
struct ProgressState {
  /// "read", "sizes", "sample", "refine", "optimize", "audit", "write"; of other jobs "plan", "verify", "compare".
  std::string_view stage;
  std::string_view doing;              ///< what is being done now: "R3.1", "faces", a file's name; may be empty
  std::uint64_t done = 0;              ///< units of work finished (vertices while refining)
  std::optional<std::uint64_t> total;  ///< estimated units in all, if known
  std::uint64_t pending = 0;           ///< elements known to violate a rule, while refining
};

/// Override to watch or to cancel. The computation waits for what is called here, so it should not take long.
class Progress {
 public:
  virtual ~Progress() = default;
  /// Says where the computation stands. Called on the thread that computes. Default: nobody listens.
  virtual void report(const ProgressState&) {}
  /// Polled at safe points, from several threads at once; true makes the computation stop and return what it has,
  /// marked as cancelled. Once true it must stay so.
  virtual bool cancelled() const { return false; }
  /// Whether it is cancelled because a budget is used up. mesh_domain() and mesh_and_optimize(), if they have a mesh by
  /// then, end as at their limit of vertices, and return that mesh. Called as cancelled() is.
  virtual bool out_of_budget() const { return false; }
};

}  // namespace scantet
