// A job's size, unless it asks for more vertices than there could be.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scantet/size_options/size_choice.h"

namespace scantet {

/// What a job may cost, and what messages call it.
struct SizeLimits {
  std::string input;                     ///< what is meshed, for messages
  double alpha = 1;                      ///< MesherOptions::alpha
  std::uint64_t max_vertices = 0;        ///< MesherOptions::max_vertices
  std::uint64_t usual_max_vertices = 0;  ///< its default
  std::optional<double> memory_bytes;    ///< --max-memory; none: what the machine has available
  std::string memory_text;               ///< the same as typed
  bool refuse = true;                    ///< false: a size that will not do is not refused, as for a plan
};

/// Makes the size field as choose_size does. Where it means more vertices than limits.max_vertices, or several
/// levels are closer to each other than it, a note says so. Throws Error: as choose_size does; usage.size, with a size
/// that will do: one finer than the domain can tell, or one that means more than ten times max_vertices, or its default
/// if that is more; usage.max_vertices: fewer than half of what the boundary takes at the sizes of "auto"; usage.gap:
/// levels so close that they mean too many; usage.memory: a mesh that takes more memory than --max-memory, or than the
/// machine has available.
///
/// With sizes.target_tets the size is chosen by choose_target_size(); without any size, and with limits.memory_bytes,
/// the input's is made larger where its mesh would take more. Throws Error: also usage.target_tets (sizes or layers are
/// asked for beside it, or no size gives so few).
ChosenSize choose_affordable_size(const SizeOptions& sizes, const SizePlan& plan, const SizeLimits& limits,
                                  const OpenedDomain& opened, Progress& progress);

}  // namespace scantet
