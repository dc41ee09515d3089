// The options of the job: their names, and the way from one list of values to the job and its plugin.
#include "scantet/app/mesh_job.h"

#include <gtest/gtest.h>

#include "scantet/base/error.h"

namespace scantet {
namespace {

struct ParsedJob {
  MeshJob job;
  OptionSet options;
  std::optional<double> level;
  OptionSet plugin_options;

  ParsedJob() {
    job.declare_options(options);
    plugin_options.add("level", level, Range(), {"Fake", "V", "a level", "Where."});
  }
  void set(const std::string& name, const std::string& text) {
    distribute_options({{name, text, "--" + name}}, options, {&plugin_options}, job);
  }
};

TEST(MeshJobOptions, SetTheFieldsOfTheJob) {
  ParsedJob j;
  j.set("size", "2");
  j.set("alpha", "0.5");
  j.set("facet-radius-edge", "1.2");
  j.set("cell-radius-edge", "2.5");
  j.set("small-slack", "1.25");
  j.set("facet-distance", "0.1");
  j.set("max-vertices", "1e6");
  j.set("seed", "9");
  j.set("space", "ras");
  j.set("output", "a.vtu");
  j.set("output", "b.stl");
  j.set("report", "a.json");
  EXPECT_EQ(j.job.sizes.size, "2");
  EXPECT_EQ(j.job.mesher.bounds.alpha, 0.5);
  EXPECT_EQ(j.job.mesher.bounds.facet_radius_edge, 1.2);
  EXPECT_EQ(j.job.mesher.bounds.cell_radius_edge, 2.5);
  EXPECT_EQ(j.job.mesher.bounds.small_slack, 1.25);
  EXPECT_EQ(j.job.mesher.bounds.facet_distance_mm, 0.1);
  EXPECT_EQ(j.job.mesher.max_vertices, 1000000u);
  EXPECT_EQ(j.job.mesher.seed, 9u);
  EXPECT_EQ(j.job.space, Space::ras);
  EXPECT_EQ(j.job.outputs, (std::vector<std::string>{"a.vtu", "b.stl"}));
  EXPECT_EQ(j.job.reports, std::vector<std::string>{"a.json"});
  EXPECT_EQ(j.job.given.size(), 12U);
  EXPECT_EQ(j.job.given[1].place, "--alpha");
}

TEST(MeshJobOptions, DefaultsAreThoseOfTheMesher) {
  const ParsedJob j;
  const MesherOptions mesher;
  EXPECT_EQ(j.options.find("alpha")->default_values.front(), number_text(mesher.bounds.alpha));
  EXPECT_EQ(j.options.find("max-vertices")->default_values.front(), std::to_string(mesher.max_vertices));
  EXPECT_TRUE(j.options.find("size")->default_values.empty());
}

TEST(MeshJobOptions, PluginOptionsAreKeptForThePlugin) {
  ParsedJob j;
  j.set("level", "60");
  ASSERT_EQ(j.job.input_options.size(), 1u);
  EXPECT_EQ(j.job.input_options[0].name, "level");
  EXPECT_EQ(j.job.input_options[0].text, "60");
  EXPECT_FALSE(j.level) << "the options used for parsing stay untouched";
}

TEST(MeshJobOptions, UnknownNamesGetTheClosestOfAll) {
  ParsedJob j;
  for (const auto& [typed, meant] : {std::pair{"levle", "level"}, std::pair{"sizze", "size"}}) {
    try {
      j.set(typed, "1");
      FAIL() << typed;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), "usage.unknown_option");
      EXPECT_NE(std::string(error.what()).find(std::string("did you mean ") + meant), std::string::npos);
    }
  }
}

TEST(MeshJobOptions, EveryOptionIsDescribed) {
  const ParsedJob j;
  for (const Option& option : j.options.options()) {
    EXPECT_FALSE(option.text.group.empty()) << option.name;
    EXPECT_GT(option.text.help.size(), 20u) << option.name;
    EXPECT_EQ(option.text.help.back(), '.') << option.name;
    EXPECT_EQ(option.text.metavar.empty(), option.kind == OptionKind::flag) << option.name;
  }
}

}  // namespace
}  // namespace scantet
