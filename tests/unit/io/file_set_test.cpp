#include "scantet/io/file_set.h"

#include <gtest/gtest.h>

#include "io_test_support.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/sha256.h"

namespace scantet {
namespace {

namespace fs = std::filesystem;

class FileSetTest : public IoTest {
 protected:
  void add(FileSet& set, const std::string& name) {
    write_file(
        file(name), [&](std::ostream& out) { out << "new " << name; }, &set);
  }
};

TEST_F(FileSetTest, FilesAppearTogether) {
  put_content(file("b"), "old");
  FileSet set;
  add(set, "a");
  add(set, "b");
  EXPECT_FALSE(fs::exists(file("a")));
  EXPECT_EQ(content_of(file("b")), "old");
  ASSERT_EQ(set.entries().size(), 2U);
  EXPECT_EQ(set.entries()[1].path, file("b"));
  EXPECT_EQ(set.entries()[1].sha256, sha256_text("new b"));
  set.commit();
  EXPECT_EQ(content_of(file("a")), "new a");
  EXPECT_EQ(content_of(file("b")), "new b");
  EXPECT_EQ(files_in_folder(), 2U);
}

TEST_F(FileSetTest, WithoutCommitNoneAppears) {
  put_content(file("b"), "old");
  {
    FileSet set;
    add(set, "a");
    add(set, "b");
  }
  EXPECT_EQ(content_of(file("b")), "old");
  EXPECT_EQ(files_in_folder(), 1U);
}

TEST_F(FileSetTest, WhatIsThereOfAnIncompleteSetIsTold) {
  FileSet set;
  for (const char* name : {"a", "b", "c"}) add(set, name);
  fs::create_directory(file("b"));
  const Error error = error_of([&] { set.commit(); });
  EXPECT_EQ(error.code(), "output.partial");
  EXPECT_EQ(error.fault(), Fault::output);
  EXPECT_NE(std::string(error.what()).find("'" + file("b") + "'"), std::string::npos) << error.what();
  EXPECT_NE(std::string(error.what()).find("only '" + file("a") + "'"), std::string::npos) << error.what();
  EXPECT_FALSE(fs::exists(file("c")));
}

}  // namespace
}  // namespace scantet
