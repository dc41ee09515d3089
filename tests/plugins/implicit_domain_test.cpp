// The plugin from outside: what it opens, and what it says when it does not.
#include <gtest/gtest.h>

#include "cancelled_after.h"
#include "contract/plugin_case.h"
#include "scantet/base/error.h"

namespace scantet {
namespace {

std::unique_ptr<Domain> open_formula(const std::string& formula, const std::string& bounds) {
  return open_with_plugin(SCANTET_IMPLICIT_PLUGIN, "implicit:" + formula, {{"bounds", bounds}});
}

TEST(ImplicitPlugin, OpeningCanBeCancelledBetweenAnyTwoEvaluations) {
  const std::string input = "implicit:gyroid";
  PluginRegistry registry;
  load_plugin(SCANTET_IMPLICIT_PLUGIN, registry);
  test::expect_cancellable(
      10'000, [&](Progress& progress) { return registry.create_for(input)->open(input, progress).domain != nullptr; });
  test::CancelledAfter progress(0);
  EXPECT_TRUE(registry.create_for(input)->info(input, progress).empty());
}

struct Refusal {
  std::string formula;
  std::string bounds;
  std::string code;
  std::string says;
};

TEST(ImplicitPlugin, RefusesWithTheReason) {
  const std::string unit = "-1,-1,-1,1,1,1";
  for (const Refusal& r : std::vector<Refusal>{
           {"x^2 + q", unit, "input.formula", "character 7"},
           {"x^2+y^2+z^2-1", unit, "input.bounds", "x = -1"},
           {"x^2+y^2+z^2-0.99999999999999", unit, "input.bounds", "x = -1"},
           {"x^2+y^2+z^2-1", "-2,-2,-2,2,2,0.5", "input.bounds", "z = 0.5"},
           {"x", unit, "input.bounds", "meets"},
           {"1/x", unit, "input.formula", "inf at (0, -1, -1)"},
           {"sqrt(x)-9", unit, "input.formula", "nan"},
           {"x^2+y^2+z^2+1", unit, "input.empty", "least value is 1"},
           {"x", "-1,-1,-1,1,1", "usage.value", "six numbers"},
           {"x", "-1,-1,-1,1,1,1,1", "usage.value", "goes on"},
           {"x", "-1,-1,-1,1,nan,1", "usage.value", "six numbers"},
           {"x", "-1,-1,-1,1,-1,1", "usage.value", "along y"},
       }) {
    try {
      open_formula(r.formula, r.bounds);
      ADD_FAILURE() << r.formula << " in " << r.bounds << " was opened";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), r.code) << error.what();
      EXPECT_NE(std::string(error.what()).find(r.says), std::string::npos) << error.what();
    }
  }
}

TEST(ImplicitPlugin, BoundsAreNeededForAFormulaOnly) {
  EXPECT_NE(open_with_plugin(SCANTET_IMPLICIT_PLUGIN, "implicit:sphere"), nullptr);
  try {
    open_with_plugin(SCANTET_IMPLICIT_PLUGIN, "implicit:x^2+y^2+z^2-1");
    ADD_FAILURE() << "opened without bounds";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "usage.bounds_missing");
    EXPECT_EQ(error.fault(), Fault::usage);
  }
}

TEST(ImplicitPlugin, OutsideOfTheBoxIsOutside) {
  const auto domain = open_formula("sin(x)*sin(y)*sin(z) + 1e-9 + max(abs(x), abs(y), abs(z))^8 - 1", "-3,-3,-3,3,3,3");
  const Box box = domain->bounds();
  Crossings crossings;
  domain->crossings({box.min - Vec{5, 0, 0}, box.min - Vec{1, 0, 0}}, crossings);
  EXPECT_TRUE(crossings.empty());
  EXPECT_EQ(domain->region_at({0.1, 0.1, 0.1}), 1);
  EXPECT_EQ(domain->region_at({4, 0, 0}), kOutside);
  domain->crossings({{0.1, 0.1, 0.1}, {1e12, 1e11, 0.1}}, crossings);
  EXPECT_EQ(crossings.size(), 1u);
}

}  // namespace
}  // namespace scantet
