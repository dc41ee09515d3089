// The choice of a plugin, and what happens when none fits.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "error_code.h"
#include "scantet/app/built_in_plugins.h"
#include "scantet/base/error.h"
#include "scantet/plugin/plugin_check.h"
#include "scantet/plugin/plugin_registry.h"
#include "unit/app/fake_plugin.h"

namespace scantet {
namespace {

TEST(PluginRegistry, PicksTheBestScoreAndTheFirstOnATie) {
  PluginRegistry registry;
  registry.add(fake_plugin("low", ".ball", 10));
  registry.add(fake_plugin("high", ".ball", 90));
  registry.add(fake_plugin("other", ".cube", 100));
  registry.add(fake_plugin("tie", ".ball", 90));
  EXPECT_EQ(registry.create_for("a.ball")->name(), "high");
  EXPECT_EQ(registry.create_for("a.cube")->name(), "other");
}

TEST(PluginRegistry, PicksTheConverterForBothNames) {
  PluginRegistry registry;
  registry.add(fake_plugin("low", ".ball", 10));
  registry.add(fake_plugin("high", ".ball", 90));
  EXPECT_EQ(registry.create_converter("a.ball", "a.txt")->name(), "high");
  EXPECT_EQ(registry.create_converter("a.ball", "a.vtu"), nullptr);
  EXPECT_EQ(registry.create_converter("a.cube", "a.txt"), nullptr);
}

TEST(PluginRegistry, ConversionsAreLookedAt) {
  FakePlugin plugin("fake", ".ball", 90);
  Progress progress;
  const std::string file = testing::TempDir() + std::to_string(getpid()) + "_scantet_converted.txt";
  const auto convert = [&](const std::string& input) { return convert_checked(plugin, input, file, progress); };
  for (const char* input : {"fails.ball", "forgets.ball", "gives_up.ball"}) {
    EXPECT_EQ(test::error_code([&] { convert(input); }), "internal.plugin") << input;
  }
  EXPECT_TRUE(convert("a.ball"));
  EXPECT_EQ(test::error_code([&] { convert(file); }), "usage.same_file");
  EXPECT_EQ(test::error_code([&] { convert_checked(plugin, "a.ball", "/nonexistent/a.txt", progress); }),
            "output.cannot_write");
  std::filesystem::remove(file);
}

TEST(PluginRegistry, EveryJobHasItsOwnPlugin) {
  PluginRegistry registry;
  registry.add(fake_plugin("ball", ".ball", 10));
  const auto a = registry.create_for("a.ball");
  const auto b = registry.create_for("a.ball");
  OptionSet of_a;
  OptionSet of_b;
  a->declare_options(of_a);
  b->declare_options(of_b);
  of_a.set({"radius", "3", "--radius"});
  EXPECT_EQ(of_a.find("radius")->read(), std::vector<std::string>{"3"});
  EXPECT_EQ(of_b.find("radius")->read(), std::vector<std::string>{"10"});
}

TEST(PluginRegistry, RefusesASecondPluginOfAName) {
  PluginRegistry registry;
  registry.add(fake_plugin("one", ".x", 1), "one.so");
  try {
    registry.add(fake_plugin("one", ".y", 1), "two.so");
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "usage.plugin");
    EXPECT_NE(std::string(error.what()).find("one.so"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("two.so"), std::string::npos) << error.what();
  }
  EXPECT_EQ(registry.create_all().size(), 1u);
}

TEST(PluginRegistry, SaysWhyNothingOpensAnInput) {
  PluginRegistry registry;
  registry.add(fake_plugin("ball", ".ball", 10));
  EXPECT_EQ(test::error_code([&] { registry.create_for("/nonexistent/a.cube"); }), "input.not_found");
  const std::string file = testing::TempDir() + std::to_string(getpid()) + "_scantet_registry_test.cube";
  std::ofstream(file).close();
  EXPECT_EQ(test::error_code([&] { registry.create_for(file); }), "input.empty");
  std::ofstream(file) << "cube";
  EXPECT_EQ(test::error_code([&] { registry.create_for(file); }), "input.format");
  std::filesystem::remove(file);
  EXPECT_EQ(test::error_code([&] { PluginRegistry().create_for(testing::TempDir()); }), "input.format");
}

TEST(PluginRegistry, ImagesAreBuiltIn) {
  const auto plugins = built_in_plugins().create_all();
  ASSERT_FALSE(plugins.empty());
  EXPECT_EQ(plugins.front()->name(), "image");
  OptionSet options;
  plugins.front()->declare_options(options);
  EXPECT_NE(options.find("level"), nullptr);
  EXPECT_NE(options.find("inside"), nullptr);
  EXPECT_NE(options.find("outside"), nullptr);
}

}  // namespace
}  // namespace scantet
