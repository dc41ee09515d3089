// Whether the bounds of a job are within what the paper proves.
#pragma once

#include <optional>
#include <string>

#include "scantet/refine/mesher_options.h"
#include "scantet/report/report_theory.h"
#include "scantet/size_options/size_options.h"

namespace scantet {

/// The bounds that are not as Theorem 3 (Theorem 5 if auto goes by lr_k) needs them; nothing if all are. Where alpha is
/// too large for any radius-edge bound, these are compared with the loosest that the theorem ever asks for, which is at
/// alpha = 0.03.
std::optional<ReportTheory> beyond_proofs(const MesherOptions& mesher, const SizeOptions& sizes);

/// The same in one line, for a user who has set one of these bounds.
std::string theory_note(const ReportTheory& theory);

}  // namespace scantet
