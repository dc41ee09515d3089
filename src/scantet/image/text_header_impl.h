// A look at text headers before a format library acts on them. Internal to the reader.
#pragma once

#include <string>

namespace scantet {

/// Checks the numbers of axes and voxels that a NRRD, MetaImage or VTK header states. The libraries store them in fixed
/// arrays and 32-bit integers without a check of their own. Other files pass.
/// Throws Error: input.too_large (an axis beyond 2³¹ - 1), input.corrupt (an axis below 1, or no number),
/// input.dimension (more than 7 axes).
void check_text_header(const std::string& path);

}  // namespace scantet
