// A disk that fills up while a file is written, simulated by a limit on file sizes in a child process.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "io_test_support.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

enum ChildResult { kWritten = 10, kRightError = 11, kWrongError = 12 };

/// Writes the mesh in a child that may not write files of more than `limit` bytes. Its standard error goes to a file.
int write_with_limit(const TetMesh& mesh, const std::string& path, const std::string& messages, std::size_t limit) {
  const pid_t child = fork();
  if (child == 0) {
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): stderr is nobody's
    if (freopen(messages.c_str(), "w", stderr) == nullptr) _exit(1);
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit size{limit, limit};
    if (setrlimit(RLIMIT_FSIZE, &size) != 0) _exit(2);
    int result = kWritten;
    try {
      write_mesh(mesh, path);
    } catch (const Error& error) {
      const std::string what = error.what();
      bool is_named = false;
      for (const std::string& file : mesh_files(path)) {  // or a file in it, if it is a folder
        is_named |=
            what.find("'" + file + "'") != std::string::npos || what.find("'" + file + "/") != std::string::npos;
      }
      const bool right =
          error.code() == "output.full" && error.fault() == Fault::output && is_named && !error.remedy().empty();
      result = right ? kRightError : kWrongError;
    }
    _exit(result);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

class DiskFull : public IoTest, public testing::WithParamInterface<MeshFormat> {};

TEST_P(DiskFull, IsAnErrorAndLeavesTheOldFileAlone) {
  const TetMesh mesh = make_cube(16, 1, 2);
  const std::string path = file("mesh" + GetParam().extension);
  const std::string messages = file("messages");
  ASSERT_EQ(write_with_limit(mesh, path, messages, 1U << 30), kWritten);
  const std::vector<std::string> files = mesh_files(path);
  std::size_t whole = 0;  // the largest
  for (const std::string& file : files) {
    for (const std::string& part : files_at(file)) whole = std::max(whole, std::filesystem::file_size(part));
    std::filesystem::remove_all(file);
  }
  ASSERT_GT(whole, 4096U);
  // Nothing fits, the header fits, half fits, all but the last byte fits: the last fails only when buffers are flushed.
  for (const std::size_t limit : {std::size_t{0}, std::size_t{100}, whole / 2, whole - 1000, whole - 1}) {
    SCOPED_TRACE("limit " + std::to_string(limit) + " of " + std::to_string(whole));
    EXPECT_EQ(write_with_limit(mesh, path, messages, limit), kRightError);
    EXPECT_EQ(content_of(messages), "") << "something was printed";
    EXPECT_EQ(files_in_folder(), 1U) << "a file was left";
    write_mesh(make_cube(1), path);
    const std::string old = content_of_mesh(path);
    EXPECT_EQ(write_with_limit(mesh, path, messages, limit), kRightError);
    EXPECT_EQ(files_in_folder(), 1 + files.size()) << "a temporary file was left";
    EXPECT_TRUE(content_of_mesh(path) == old);
    for (const std::string& file : files) std::filesystem::remove_all(file);
  }
  EXPECT_EQ(write_with_limit(mesh, path, messages, whole), kWritten);
}

TEST_P(DiskFull, NoDiskAtAllIsAnErrorToo) {
  const TetMesh mesh = make_cube(2);
  put_content(file("plain"), "");
  for (const std::string& folder : {file("missing"), file("plain"), std::string("/proc")}) {
    const Error error = error_of([&] { write_mesh(mesh, folder + "/mesh" + GetParam().extension); });
    EXPECT_EQ(error.code(), "output.cannot_write");
    EXPECT_EQ(error.fault(), Fault::output);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFormat, DiskFull, testing::ValuesIn(mesh_formats()), [](const auto& test) {
  std::string name = test.param.extension.substr(1);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace scantet
