// What a run took, as people read it.
#pragma once

#include <string>
#include <vector>

#include "scantet/report/report.h"

namespace scantet {

/// "13.75 s (read 0.25, refine 12.50)"
std::string text_of(const ReportTiming& timing);
/// "boundary sample 0.75 s (500 points), classify 0.25 s"
std::string text_of(const std::vector<StageAccount>& stages);
/// "read: input 0.01, sizes 0.00; audit: measures 0.10 s"
std::string text_of(const std::vector<PhaseAccount>& phases);

}  // namespace scantet
