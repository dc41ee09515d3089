// Whether the bounds of a job are within what the paper proves.
#pragma once

#include <optional>
#include <string>

#include "scantet/app/size_options.h"
#include "scantet/refine/mesher.h"

namespace scantet {

/// One line on which bounds lie outside of Theorem 3 (Theorem 5 if auto goes by lr_k) and by how much;
/// nothing if all lie within. Where alpha is too large for any radius-edge bound, these are held against the loosest
/// that the theorem ever asks for, at alpha = 0.03.
std::optional<std::string> beyond_proofs(const MesherOptions& mesher, const SizeOptions& sizes);

}  // namespace scantet
