#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scantet/report/report_forms.h"
#include "scantet/report/report_times_impl.h"

namespace scantet {
namespace {

using Phases = std::vector<PhaseAccount>;

const Phases kPhases{{"read", "input", 0.25, 0.125}, {"audit", "faces", 1.5, 2.75}, {"audit", "boundary", 0.5, 0.5}};

TEST(ReportTimes, PhasesAreGroupedByStage) {
  EXPECT_EQ(text_of(kPhases), "read: input 0.25; audit: faces 1.50, boundary 0.50 s");
  EXPECT_EQ(text_of(Phases{}), "");
  Report report;
  report.phases = kPhases;
  EXPECT_NE(text_report(report).find("phases     read: input 0.25; audit"), std::string::npos);
}

TEST(ReportTimes, JsonHasThePhases) {
  Report report;
  report.phases = kPhases;
  const auto json = nlohmann::json::parse(json_report({&report, 1}));
  ASSERT_EQ(json["phases"].size(), 3u);
  EXPECT_EQ(json["phases"][1]["stage"], "audit");
  EXPECT_EQ(json["phases"][1]["part"], "faces");
  EXPECT_EQ(json["phases"][1]["seconds"], 1.5);
  EXPECT_EQ(json["phases"][1]["cpu_seconds"], 2.75);
}

TEST(ReportTimes, WhatWasNotDoneIsLeftOut) {
  ReportTiming timing;
  timing.read = 0.25;
  timing.refine = 12.5;
  EXPECT_EQ(text_of(timing), "read 0.25, refine 12.50 s");
  timing.total = 13.75;
  EXPECT_EQ(text_of(timing), "13.75 s (read 0.25, refine 12.50)");
  EXPECT_EQ(text_of(std::vector<StageAccount>{{"lattice", 0.5, 1}, {"classify", 0.25, 0}}),
            "lattice 0.50 s (1 point), classify 0.25 s");
}

}  // namespace
}  // namespace scantet
