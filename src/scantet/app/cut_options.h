// --border and --cut: where the object ends flat.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/options.h"

namespace SCANTET_API scantet {

/// What is done where a scan ends within the object.
enum class Border {
  close,  ///< the surface closes within one voxel beyond
  cap     ///< the object ends flat, at the outermost voxel centres
};

/// Where the object ends flat, as typed.
struct CutOptions {
  Border border = Border::close;
  std::vector<std::string> cuts{};  ///< planes: "x < 10", "-10 < x + 2z < 10", "clamp: z > -40"; mm, LPS

  /// Whether anything is to be cut.
  bool is_any() const { return border == Border::cap || !cuts.empty(); }
};

/// Declares --border and --cut. cut: what they set; must outlive `options`. Texts are read when a job begins.
void declare_cut_options(OptionSet& options, CutOptions& cut);

}  // namespace scantet
