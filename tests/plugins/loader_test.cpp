// What can be wrong with a plugin, and what is said then: always with its file.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "contract/plugin_case.h"
#include "scantet/app/built_in_plugins.h"
#include "scantet/base/error.h"

namespace scantet {
namespace {

namespace fs = std::filesystem;

std::string stub(const std::string& name) {
  return std::string(SCANTET_STUB_PLUGINS) + "/" + name + ".so";
}

/// The error of an action, "code: what"; empty if there is none.
std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.code() + ": " + error.what();
  }
  return {};
}

void expect_refused(const std::string& file, const std::string& says) {
  PluginRegistry registry = built_in_plugins();
  const std::string error = error_of([&] { load_plugin(file, registry); });
  EXPECT_EQ(error.rfind("usage.plugin: ", 0), 0u) << file << " " << error;
  EXPECT_NE(error.find(file), std::string::npos) << error;
  EXPECT_NE(error.find(says), std::string::npos) << "does not say " << says << ": " << error;
  EXPECT_EQ(registry.entries().size(), 1u) << file;
}

class PluginFolder : public testing::Test {
 protected:
  void SetUp() override { fs::create_directory(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  void put(const std::string& name, const std::string& as) { fs::copy_file(stub(name), folder_ + "/" + as); }

  std::string folder_ = testing::TempDir() + std::to_string(getpid()) + "_scantet_plugins_" +
                        testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST(PluginLoader, LoadsAPlugin) {
  PluginRegistry registry = built_in_plugins();
  load_plugin(stub("good"), registry);
  ASSERT_EQ(registry.entries().size(), 2u);
  EXPECT_EQ(registry.entries().back().file, stub("good"));
  EXPECT_EQ(registry.create_for("good:")->name(), "good");
}

TEST(PluginLoader, RefusesWhatIsNoPlugin) {
  expect_refused("/nonexistent/plugin.so", "no such file");
  expect_refused(SCANTET_STUB_PLUGINS, "not a shared library");
  const std::string text = testing::TempDir() + std::to_string(getpid()) + "_scantet_text.so";
  std::ofstream(text) << "text";
  expect_refused(text, "not a shared library");
  fs::remove(text);
  expect_refused(stub("no_descriptor"), "scantet_plugin");
}

TEST(PluginLoader, RefusesADamagedFile) {
  const std::string file = testing::TempDir() + std::to_string(getpid()) + "_scantet_cut_plugin.so";
  fs::copy_file(stub("good"), file, fs::copy_options::overwrite_existing);
  fs::resize_file(file, 1000);
  expect_refused(file, "");  // the loader of some systems crashes on it
  std::ofstream(file, std::ios::binary) << "\177ELF and nothing more";
  expect_refused(file, "cannot be loaded");
  fs::remove(file);
}

TEST(PluginLoader, RefusesAnotherInterfaceWithoutCallingIt) {
  expect_refused(stub("other_version"), "interface " + std::to_string(kInputPluginVersion + 1));
}

TEST(PluginLoader, RefusesASecondPluginOfAName) {
  expect_refused(stub("second_image"), "built in");
}

TEST(PluginLoader, RefusesOptionsThatAreTaken) {
  expect_refused(stub("takes_size"), "--size");
}

TEST(PluginLoader, SurvivesPluginsThatComeToGrief) {
  expect_refused(stub("crashes_on_load"), "crashes: Segmentation fault");
  expect_refused(stub("crashes_when_asked"), "crashes: Illegal instruction");
  expect_refused(stub("crashes_at_the_end"), "crashes: Segmentation fault");
  expect_refused(stub("throws_on_load"), "throws: a static object failed");
  expect_refused(stub("throws_when_made"), "throws: no licence found");
  expect_refused(stub("exits_when_asked"), "ends the process, with status 7");
  expect_refused(stub("never_answers"), "does not end within 10 s");
}

TEST_F(PluginFolder, BadOnesArePassedOverWithAWord) {
  put("good", "b_good.so");
  put("crashes_on_load", "a_crashes.so");
  put("good", "c_twin.so");
  put("crashes_on_load", "not_looked_at.txt");
  PluginRegistry registry = built_in_plugins();
  const std::vector<std::string> warnings = load_plugin_folder(folder_, registry);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("a_crashes.so"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("c_twin.so"), std::string::npos) << warnings[1];
  ASSERT_EQ(registry.entries().size(), 2u);
  EXPECT_EQ(registry.entries().back().file, folder_ + "/b_good.so");
}

TEST_F(PluginFolder, WhatIsLoadedAlreadyIsLeftAlone) {
  put("good", "good.so");
  PluginRegistry registry;
  load_plugin(folder_ + "/good.so", registry);
  EXPECT_TRUE(load_plugin_folder(folder_, registry).empty());
  EXPECT_EQ(registry.entries().size(), 1u);
  EXPECT_TRUE(load_plugin_folder(folder_ + "/absent", registry).empty());
}

TEST(PluginLoader, ThePluginFolderIsBesideTheLibrary) {
  EXPECT_EQ(fs::path(plugin_folder()), fs::path(SCANTET_IMPLICIT_PLUGIN).parent_path());
}

TEST(PluginCheck, HonestPluginsPass) {
  EXPECT_NE(open_with_plugin(stub("good"), "good:"), nullptr);
  EXPECT_NE(open_with_plugin(stub("liar"), "liar:"), nullptr);
}

TEST(PluginCheck, LiesAreFoundOut) {
  const std::vector<std::pair<std::string, std::string>> lies{
      {"cuts", "input.bounds"},     {"grazes", "input.bounds"},    {"within", "input.bounds"},
      {"infinite", "input.bounds"}, {"empty", "input.bounds"},     {"nothing", "internal.plugin"},
      {"size", "internal.plugin"},  {"throws", "internal.plugin"}, {"throws_later", "internal.plugin"}};
  for (const auto& [how, code] : lies) {
    const std::string input = "liar:" + how;
    const std::string error = error_of([&] { open_with_plugin(stub("liar"), input); });
    EXPECT_EQ(error.rfind(code + ": ", 0), 0u) << how << ": " << error;
    EXPECT_NE(error.find("plugin liar"), std::string::npos) << error;
  }
}

}  // namespace
}  // namespace scantet
