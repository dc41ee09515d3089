// Whether the bounds of a job are within what the paper proves.
#pragma once

#include <optional>
#include <string>

#include "scantet/app/size_options.h"
#include "scantet/refine/mesher.h"
#include "scantet/report/report_theory.h"

namespace scantet {

/// Which bounds Theorem 3 (Theorem 5 if auto goes by lr_k) would need that these are not within; nothing if all hold.
/// Where alpha is too large for any radius-edge bound, these are held against the loosest that the theorem ever asks
/// for, at alpha = 0.03.
std::optional<ReportTheory> beyond_proofs(const MesherOptions& mesher, const SizeOptions& sizes);

/// The same in one line, for whoever has set one of these bounds.
std::string theory_note(const ReportTheory& theory);

}  // namespace scantet
