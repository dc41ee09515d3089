// Progress and cancellation go through one object; the default does nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// Where a long computation stands.
struct ProgressState {
  std::string_view stage;              ///< "read", "sample", "refine", "optimize", "audit", "write"
  std::string_view doing;              ///< what is being done now: "R3.1", "faces", a file's name; may be empty
  std::uint64_t done = 0;              ///< units of work finished (vertices while refining)
  std::optional<std::uint64_t> total;  ///< estimated units in all, if known
  std::uint64_t pending = 0;           ///< elements known to violate a rule, while refining
};

/// Override to watch or to cancel. Called from the computing thread, a few hundred times a second at most.
class Progress {
 public:
  virtual ~Progress() = default;
  /// Says where the computation stands. Default: nobody listens.
  virtual void report(const ProgressState&) {}
  /// Polled at safe points; true makes the computation stop and return what it has, marked as cancelled.
  virtual bool cancelled() const { return false; }
  /// Whether it is cancelled because a budget is used up (see Budget). A computation that has a mesh by then ends as at
  /// its limit of vertices, and returns that mesh.
  virtual bool out_of_budget() const { return false; }
};

}  // namespace scantet
