// Whether the bounds of a job are within what the paper proves.
#pragma once

#include <optional>
#include <string>

#include "scantet/refine/mesher_options.h"
#include "scantet/report/report_theory.h"
#include "scantet/size_options/size_options.h"

namespace scantet {

/// Which bounds Theorem 3 (Theorem 5 if auto goes by lr_k) would need that these are not within; nothing if all hold.
/// Where alpha is too large for any radius-edge bound, these are held against the loosest that the theorem ever asks
/// for, at alpha = 0.03.
std::optional<ReportTheory> beyond_proofs(const MesherOptions& mesher, const SizeOptions& sizes);

/// The same in one line, for whoever has set one of these bounds.
std::string theory_note(const ReportTheory& theory);

}  // namespace scantet
