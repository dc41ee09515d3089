#include "scantet/io/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "io_test_support.h"

namespace scantet {
namespace {

namespace fs = std::filesystem;
using AtomicFileTest = IoTest;

TEST_F(AtomicFileTest, AppearsOnCommitOnly) {
  {
    AtomicFile output(file("out.txt"));
    EXPECT_TRUE(fs::exists(output.part_path()));
    const std::string part = fs::path(output.part_path()).filename();
    EXPECT_TRUE(part.starts_with(".scantet-") && part.ends_with("." + std::to_string(getpid()) + ".part")) << part;
    EXPECT_FALSE(fs::exists(file("out.txt")));
    put_content(output.part_path(), "whole");
    output.commit();
    EXPECT_EQ(content_of(file("out.txt")), "whole");
    EXPECT_FALSE(fs::exists(output.part_path()));
    EXPECT_EQ(error_of([&] { output.commit(); }).code(), "output.committed");
  }
  EXPECT_EQ(files_in_folder(), 1U);
}

TEST_F(AtomicFileTest, AStreamLeftInAFailedStateCommitsNothing) {
  const auto fail = [](std::ostream& out) { out.setstate(std::ios::failbit); };
  EXPECT_EQ(error_of([&] { write_file(file("out.txt"), fail); }).code(), "output.stream");
  EXPECT_EQ(files_in_folder(), 0U);
}

TEST_F(AtomicFileTest, WithoutCommitTheOldFileStays) {
  put_content(file("out.txt"), "old");
  { const AtomicFile output(file("out.txt")); }
  EXPECT_EQ(content_of(file("out.txt")), "old");
  const auto fail = [](std::ostream& out) {
    out << "half of it";
    throw Error(Fault::internal, "test", "the writer gives up");
  };
  EXPECT_EQ(error_of([&] { write_file(file("out.txt"), fail); }).code(), "test");
  EXPECT_EQ(content_of(file("out.txt")), "old");
  EXPECT_EQ(files_in_folder(), 1U);
}

TEST_F(AtomicFileTest, LargeContentIsWrittenWhole) {
  const std::string block(300'001, 'x');
  write_file(file("out.txt"), [&](std::ostream& out) {
    for (int i = 0; i < 20; ++i) out << block << i;
  });
  EXPECT_EQ(content_of(file("out.txt")).size(), 20 * block.size() + 30);
}

TEST_F(AtomicFileTest, RelativePathsAndALaterChangeOfFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  {
    AtomicFile output("out.txt");
    fs::current_path(before);
    output.commit();
  }
  EXPECT_TRUE(fs::exists(file("out.txt")));
}

TEST_F(AtomicFileTest, ALinkIsFollowedAndPermissionsAreKept) {
  put_content(file("real.txt"), "old");
  fs::permissions(file("real.txt"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("real.txt", file("link.txt"));
  write_file(file("link.txt"), [](std::ostream& out) { out << "new"; });
  EXPECT_TRUE(fs::is_symlink(file("link.txt")));
  EXPECT_EQ(content_of(file("real.txt")), "new");
  EXPECT_EQ(fs::status(file("real.txt")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(AtomicFileTest, ALinkToWhereNothingIsYetStaysALink) {
  fs::create_symlink("second.txt", file("first.txt"));
  fs::create_symlink("real.txt", file("second.txt"));
  write_file(file("first.txt"), [](std::ostream& out) { out << "new"; });
  EXPECT_TRUE(fs::is_symlink(file("first.txt")));
  EXPECT_TRUE(fs::is_symlink(file("second.txt")));
  EXPECT_EQ(content_of(file("real.txt")), "new");
  fs::create_symlink("loop.txt", file("loop.txt"));
  EXPECT_EQ(error_of([&] { write_file(file("loop.txt"), [](std::ostream&) {}); }).code(), "output.cannot_write");
}

TEST_F(AtomicFileTest, NamesMayBeAsLongAsTheSystemAllows) {
  const std::string longest(255, 'n');
  write_file(file(longest), [](std::ostream& out) { out << "whole"; });
  EXPECT_EQ(content_of(file(longest)), "whole");
}

TEST_F(AtomicFileTest, WhatAKilledProcessLeftIsTakenAwayAndWhatALivingOneWritesIsNot) {
  const pid_t child = fork();
  if (child == 0) {
    const AtomicFile left(file("out.txt"));
    const AtomicFile other(file("other.txt"));
    raise(SIGKILL);
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_EQ(files_in_folder(), 2U);
  {
    const AtomicFile living(file("out.txt"));
    EXPECT_EQ(files_in_folder(), 2U) << "the one left of out.txt has gone, that of other.txt is not looked at";
    write_file(file("out.txt"), [](std::ostream& out) { out << "new"; });
    EXPECT_TRUE(fs::exists(living.part_path()));
  }
  write_file(file("other.txt"), [](std::ostream& out) { out << "new"; });
  EXPECT_EQ(files_in_folder(), 2U);
}

TEST_F(AtomicFileTest, ImpossiblePlacesAreRefusedWithReasonAndRemedy) {
  put_content(file("plain"), "");
  fs::create_directory(file("folder"));
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  struct Case {
    std::string path;
    std::string reason;
  };
  const Case cases[] = {{file("missing/out.txt"), "No such file or directory"},
                        {file("plain/out.txt"), "Not a directory"},
                        {file("folder"), "Is a directory"},
                        {file("folder/"), "Is a directory"},
                        {file("pipe"), "it is a device, pipe or socket"},
                        {"/dev/null", "it is a device, pipe or socket"},
                        {"/proc/scantet.txt", "No such file or directory"},
                        {"", "No such file or directory"},
                        {file(std::string(300, 'n')), "File name too long"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.path);
    const Error error = error_of([&] { write_file(c.path, [](std::ostream&) {}); });
    EXPECT_EQ(error.code(), "output.cannot_write");
    EXPECT_EQ(error.fault(), Fault::output);
    EXPECT_NE(std::string(error.what()).find("'" + c.path + "': " + c.reason), std::string::npos) << error.what();
    EXPECT_FALSE(error.remedy().empty());
  }
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(files_in_folder(), 3U);
}

TEST_F(AtomicFileTest, LackOfSpaceHasACodeOfItsOwn) {
  const Error error = error_of([] { throw_output_error("x.vtu", ENOSPC); });
  EXPECT_EQ(error.code(), "output.full");
  EXPECT_STREQ(error.what(), "cannot write 'x.vtu': No space left on device; free some space or write to another disk");
}

TEST_F(AtomicFileTest, ManyFilesAtOnceEndInAnErrorNotInACrash) {
  std::vector<std::unique_ptr<AtomicFile>> open_files;
  const Error error = error_of([&] {
    for (int i = 0; i < 1000; ++i) open_files.push_back(std::make_unique<AtomicFile>(file(std::to_string(i))));
  });
  EXPECT_EQ(error.code(), "output.cannot_write");
  EXPECT_GE(open_files.size(), 16U);
  open_files.clear();
  EXPECT_EQ(files_in_folder(), 0U);
  write_file(file("out.txt"), [](std::ostream& out) { out << "slots are free again"; });
}

void remove_and_die(int) {
  remove_unfinished_files();
  _exit(42);
}

TEST_F(AtomicFileTest, ASignalHandlerCanRemoveUnfinishedFiles) {
  put_content(file("b.txt"), "old");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGINT, remove_and_die);
    AtomicFile a(file("a.txt"));
    AtomicFile b(file("b.txt"));
    AtomicFile c(file("c.txt"));
    c.commit();
    raise(SIGINT);
    _exit(1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_EQ(files_in_folder(), 2U);  // b.txt and c.txt
  EXPECT_EQ(content_of(file("b.txt")), "old");
}

}  // namespace
}  // namespace scantet
