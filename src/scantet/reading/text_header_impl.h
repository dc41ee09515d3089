// A look at text headers before a format library acts on them. Internal to the reader.
#pragma once

#include <string>

#include "scantet/base/api.h"

namespace SCANTET_PROGRAM_API scantet {

/// Checks what a NRRD, MetaImage or VTK header states as far as the libraries do not: they store lines, words and
/// numbers of axes and voxels in fixed arrays and 32-bit integers, and open whatever file is named. Others pass.
/// Throws Error: input.too_large (an axis beyond 2³¹ - 1), input.corrupt (an axis below 1, no number, a line, a word
/// or a list too long, what a MetaImage header cannot hold, voxels that are not beside the header), input.dimension
/// (more than 7 axes), input.not_a_file (voxels in a pipe or device).
void check_text_header(const std::string& path);

/// The part for MetaImage. head: the first bytes of the file.
void check_meta_header(const std::string& path, const std::string& head);

/// Checks the name of a file of voxels that a header holds: it lies beside the header or in a folder there, and is a
/// file if it exists. A pattern ("slice%03d.raw"): so are all that it may name. Throws Error: input.corrupt,
/// input.not_a_file.
void check_voxel_file(const std::string& path, const std::string& name);

}  // namespace scantet
