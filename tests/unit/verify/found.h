// Whether a certificate has a finding.
#pragma once

#include <algorithm>
#include <string>

#include "scantet/verify/verify.h"

namespace scantet::test {

inline bool has(const Certificate& c, const std::string& code) {
  return std::any_of(c.findings.begin(), c.findings.end(), [&](const VerifyFinding& f) { return f.code == code; });
}

}  // namespace scantet::test
