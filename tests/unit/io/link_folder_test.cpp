#include "scantet/io/link_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace scantet {
namespace {

namespace fs = std::filesystem;

class LinkFolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* const before = std::getenv("TMPDIR");
    if (before != nullptr) before_ = before;
    std::string name = (fs::temp_directory_path() / "link_folder_test-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    setenv("TMPDIR", folder_.c_str(), 1);
  }
  void TearDown() override {
    fs::remove_all(folder_);
    if (before_.empty()) {
      unsetenv("TMPDIR");
    } else {
      setenv("TMPDIR", before_.c_str(), 1);
    }
  }
  std::ptrdiff_t entries() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }

  fs::path folder_;
  std::string before_;
};

TEST_F(LinkFolderTest, LinksHaveTheirNamesAndAreGoneWithIt) {
  const fs::path part = folder_ / "part";
  std::ofstream(part) << "content";
  {
    const LinkFolder links;
    const std::string link = links.add("/somewhere/mesh.vtu", part.string());
    EXPECT_EQ(fs::path(link).filename(), "mesh.vtu");
    EXPECT_TRUE(fs::equivalent(link, part));
    EXPECT_EQ(entries(), 2);
  }
  EXPECT_EQ(entries(), 1);
  EXPECT_TRUE(fs::exists(part)) << "what a link points to stays";
}

TEST_F(LinkFolderTest, WhatAKilledProcessLeftIsTakenAway) {
  const pid_t child = fork();
  if (child == 0) {
    const LinkFolder links;
    links.add("a.vtu", "/nowhere");
    raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(entries(), 1);
  { const LinkFolder links; }
  EXPECT_EQ(entries(), 0);
}

}  // namespace
}  // namespace scantet
