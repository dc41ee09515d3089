// Bent grids, and what an audit of them should find. Shared by the tests of the audit against domains.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "scantet/check/audit.h"
#include "unit/quality/grid_mesh.h"

namespace scantet::test {

constexpr double kRadius = 10;

// Bent grids are no Delaunay triangulations.
inline AuditOptions bent() {
  AuditOptions options;
  options.restricted_delaunay = false;
  return options;
}

// For meshes that leave out parts of a ball: their new faces are not on its boundary.
inline AuditOptions anywhere() {
  AuditOptions options = bent();
  options.max_residual = 10;
  return options;
}

inline std::string messages(const AuditReport& report) {
  std::string text;
  for (const Finding& finding : report.findings) text += finding.message + "\n";
  return text;
}

inline void expect_only(const AuditReport& report, const std::string& code, std::uint64_t count) {
  ASSERT_EQ(report.findings.size(), 1u) << messages(report);
  EXPECT_EQ(report.findings[0].code, code);
  EXPECT_EQ(report.findings[0].count, count) << report.findings[0].message;
  EXPECT_FALSE(report.findings[0].remedy.empty());
}

}  // namespace scantet::test
