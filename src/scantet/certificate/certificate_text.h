// A certificate in words.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/verify/verify.h"

namespace SCANTET_API scantet {

/// What was proved of a mesh, level by level, the outermost first.
struct MeshCertificate {
  std::vector<double> levels;             ///< one for each certificate; none of a label map or a surface
  std::vector<Certificate> certificates;  ///< one a level, at least one

  /// The least of all levels.
  CertificateGrade grade() const;
};

/// Whether the grade is the required one or a better one, as `certified` is than `bounded`.
bool reaches(CertificateGrade grade, CertificateGrade required);

/// The certificate for people: lines, each with a line feed at its end. Long lists are cut off: the first 30 findings,
/// 40 regions, 5 undecided places.
std::string certificate_text(const Certificate& certificate);

/// The same of all levels, each under a heading if there are several. Pre: at least one certificate, and a level for
/// each if there are several.
std::string certificate_text(const MeshCertificate& certificate);

/// "certified: 4358 of 4358 facets have a collar; …": one line, without a line feed, with all findings.
std::string certificate_summary(const Certificate& certificate);

}  // namespace scantet
