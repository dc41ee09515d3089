// A certificate in words.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/verify/verify.h"

namespace SCANTET_API scantet {

/// What was proved of a mesh, level by level, the outermost first.
struct MeshCertificate {
  std::vector<double> levels;             ///< none of a label map or a surface
  std::vector<Certificate> certificates;  ///< one a level, at least one

  /// The least of all levels.
  CertificateGrade grade() const;
};

/// Whether the grade is the required one or better.
bool reaches(CertificateGrade grade, CertificateGrade required);

/// The certificate for people: lines.
std::string certificate_text(const Certificate& certificate);

/// The same of all levels, each under a heading if there are several.
std::string certificate_text(const MeshCertificate& certificate);

/// "certified: 4,358 of 4,358 facets have a collar; …": one line.
std::string certificate_summary(const Certificate& certificate);

}  // namespace scantet
