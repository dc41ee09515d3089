// What the end of a file's name says of its format.
#pragma once

#include <string>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// The extension of the path's last part, in lower case (of ASCII, in any locale) and with its dot: ".nrrd" of
/// "a/Head.NRRD", ".gz" of "a.nii.gz". Empty if there is none; "a/.nrrd" has none.
std::string file_extension(const std::string& path);

}  // namespace scantet
