// Output files: whole or not at all, checked before the work, the same bytes every time.
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>

#include "run_process.h"

namespace scantet {
namespace {

std::vector<std::string> coarse_sphere(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"mesh", sample("sphere.nrrd"), "--level", "127.5", "--size", "3"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

void expect_refused(const std::vector<std::string>& more, int status, const std::string& says) {
  const TestFolder folder;
  const RunResult run = run_scantet(coarse_sphere(more), {folder.path()});
  EXPECT_EQ(run.status, status) << run.err;
  EXPECT_EQ(run.out, "") << "no mesh was made";
  EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("scantet: hint: "), std::string::npos) << run.err;
  EXPECT_TRUE(folder.names().empty());
}

TEST(Output, EveryFormatIsWritten) {
  const TestFolder folder;
  const std::vector<std::string> names{"a.bdf", "a.csv",  "a.e",   "a.exo",  "a.feb", "a.h5",   "a.html",
                                       "a.inp", "a.json", "a.med", "a.mesh", "a.msh", "a.msh2", "a.ply",
                                       "a.png", "a.stl",  "a.svg", "a.vtk",  "a.vtu", "a.xdmf"};
  const std::vector<std::string> reports{"a.csv", "a.html", "a.json", "a.png", "a.svg"};
  std::vector<std::string> more;
  for (const std::string& name : names) {
    if (name == "a.h5") continue;  // it comes with a.xdmf
    const bool report = std::find(reports.begin(), reports.end(), name) != reports.end();
    more.insert(more.end(), {report ? "--report" : "-o", folder / name});
  }
  const RunResult run = run_scantet(coarse_sphere(more));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.names(), names);
  for (const std::string& name : names) {
    EXPECT_FALSE(read_bytes(folder / name).empty()) << name;
    EXPECT_NE(run.out.find("wrote " + (folder / name)), std::string::npos) << name;
  }
}

// The names of what takes its name in a folder, in order, since the watch was set up.
std::vector<std::string> names_moved_to(int watch) {
  alignas(inotify_event) std::array<char, 1 << 16> events{};
  const ssize_t bytes = read(watch, events.data(), events.size());
  std::vector<std::string> names;
  for (ssize_t at = 0; at < bytes;) {
    const auto& event = *reinterpret_cast<const inotify_event*>(events.data() + at);
    names.emplace_back(event.name);
    at += static_cast<ssize_t>(sizeof(inotify_event) + event.len);
  }
  return names;
}

TEST(Output, FilesOfARunAppearInTheOrderThatIsDocumented) {
  const TestFolder folder;
  write_bytes(folder / "m.json", R"({"regions": {"1": {"youngs_modulus_mpa": 10, "poissons_ratio": 0.3}}})");
  const int watch = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  ASSERT_GE(inotify_add_watch(watch, folder.path().c_str(), IN_MOVED_TO), 0);
  const RunResult run = run_scantet(
      coarse_sphere({"--report",      "d.json",      "--report", "c.svg", "-o",        "b.inp",     "--deck",
                     "static",        "--materials", "m.json",   "--set", "top=z > 5", "--certify", "bounded",
                     "--certificate", "z.json",      "-o",       "a.vtu", "--report",  "b.csv"}),
      {folder.path()});
  EXPECT_TRUE(run.status == 0 || run.status == 4) << run.err;
  EXPECT_EQ(names_moved_to(watch),
            (std::vector<std::string>{"b.inp", "b_static.inp", "a.vtu", "z.json", "c.svg", "b.csv", "d.json"}));
  close(watch);
}

TEST(Output, FilesSayHowTheyWereMade) {
  const TestFolder folder;
  const RunResult run = run_scantet(
      coarse_sphere({"--cut", "x > 0", "--region-size", "1=4", "--seed", "4", "-o", "a.msh"}), {folder.path()});
  ASSERT_NE(run.status, 1) << run.err;
  const std::string mesh = read_bytes(folder / "a.msh");
  for (const char* part : {" --cut \"x > 0\"", " --region-size 1=4", " --seed 4"}) {
    EXPECT_NE(mesh.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(mesh.find("--output"), std::string::npos);
}

TEST(Output, AFileNameAddsNoLineToADeck) {
  const TestFolder folder;
  const std::string name = "s\n*INCLUDE, INPUT=secret.txt\n** {{load}} .nrrd";
  std::filesystem::copy_file(sample("sphere.nrrd"), folder / "s.nrrd");
  std::filesystem::rename(folder / "s.nrrd", folder / name);
  write_bytes(folder / "m.json", R"({"regions": {"1": {"youngs_modulus_mpa": 10, "poissons_ratio": 0.3}}})");
  const RunResult run = run_scantet({"mesh", name, "--level", "127.5", "--size", "5", "--materials", "m.json", "--deck",
                                     "static", "--set", "foot=z < -8", "--hold", "foot", "-o", "b.inp"},
                                    {folder.path()});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string deck = read_bytes(folder / "b_static.inp");
  EXPECT_EQ(deck.find("\n*INCLUDE, INPUT=secret"), std::string::npos);
  EXPECT_NE(deck.find("{{load}}"), std::string::npos) << "what is put in is not looked through";
  EXPECT_EQ(read_bytes(folder / "b.inp").find("\n*INCLUDE"), std::string::npos);
}

// What one file holds of a run after "> FILE 2>&1", and the same run with the streams apart: standard output, then
// standard error.
void expect_in_order(const std::vector<std::string>& arguments) {
  const TestFolder folder;
  const RunResult apart = run_scantet(arguments);
  RunOptions options;
  options.both_to = folder / "both";
  EXPECT_EQ(run_scantet(arguments, options).status, apart.status);
  const auto without_times = [](const std::string& text) {
    std::istringstream lines(text);
    std::string kept;
    bool of_times = false;  // a row and the lines that go on with it
    for (std::string line; std::getline(lines, line);) {
      of_times = line.starts_with("time") || line.starts_with("stages") || line.starts_with("phases") ||
                 line.starts_with("improved") || (of_times && line.starts_with(" "));
      if (!of_times) kept += line + "\n";
    }
    return kept;
  };
  EXPECT_EQ(without_times(read_bytes(folder / "both")), without_times(apart.out + apart.err)) << arguments.front();
  EXPECT_FALSE(apart.out.empty()) << arguments.front();
}

TEST(Output, BothStreamsInOneFileAreInOrder) {
  const TestFolder folder;
  // A mesh whose report is long, with notes after it; then findings after a report of several meshes.
  const std::string long_name = std::string(200, 'a') + ".vtk";
  std::vector<std::string> job{"mesh", sample("sphere.nrrd"), "--level", "127.5", "--alpha", "0.5"};
  for (int i = 0; i < 20; ++i) job.insert(job.end(), {"-o", folder / (std::to_string(i) + long_name)});
  expect_in_order(job);
  write_bytes(folder / "bad.mesh",
              "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
              "Tetrahedra\n1\n2 1 3 4 1\nEnd\n");
  expect_in_order({"report", folder / "bad.mesh", folder / ("0" + long_name), folder / "bad.mesh"});
  expect_in_order({"info", sample("sphere.nrrd")});
  expect_in_order({"convert", folder / "bad.mesh", folder / "bad.vtk"});
  expect_in_order({"plugins"});
}

TEST(Output, UnknownExtensionIsWrongUse) {
  expect_refused({"-o", "a.vtx"}, 2, "a.vtx");
  expect_refused({"-o", "a"}, 2, "no extension");
  expect_refused({"--report", "a.html5"}, 2, "a.html5");
  expect_refused({"-o", "a.vtu", "-o", "b.xyz"}, 2, "b.xyz");
}

TEST(Output, FolderMustExistAndLetUs) {
  expect_refused({"-o", "missing/a.vtu"}, 5, "missing/a.vtu");
  expect_refused({"-o", "/proc/a.vtu"}, 5, "/proc/a.vtu");
  expect_refused({"-o", "a.vtu", "--report", "missing/a.json"}, 5, "missing/a.json");
}

TEST(Output, FolderInPlaceOfTheFile) {
  const TestFolder folder;
  EXPECT_EQ(run_scantet(coarse_sphere({"-o", folder.path() + "/.."})).status, 2) << "no extension";
  const TestFolder other;
  const std::string target = other / "a.vtu";
  ASSERT_EQ(std::system(("mkdir " + target).c_str()), 0);
  const RunResult run = run_scantet(coarse_sphere({"-o", target}));
  EXPECT_EQ(run.status, 5) << run.err;
  EXPECT_NE(run.err.find(target), std::string::npos);
}

TEST(Output, NameClashesAreWrongUse) {
  expect_refused({"-o", "a.vtu", "-o", "./a.vtu"}, 2, "twice");
  expect_refused({"-o", "a.inp", "-o", "a_static.inp", "--deck", "static"}, 2, "twice");
  const TestFolder folder;
  EXPECT_EQ(run_scantet(coarse_sphere({"-o", folder / "a.vtk"})).status, 0);
  const std::string before = read_bytes(folder / "a.vtk");
  const RunResult run = run_scantet({"convert", folder / "a.vtk", folder / "a.vtk"});
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_EQ(read_bytes(folder / "a.vtk"), before);
}

// A file-size limit stands for a full disk: the write fails half-way.
TEST(Output, FullDiskLeavesNothing) {
  const TestFolder folder;
  RunOptions options;
  options.file_size_limit = 4096;
  for (const std::string name : {"a.vtu", "a.vtk", "a.msh", "a.inp", "a.feb", "a.bdf", "a.e", "a.med", "a.stl",
                                 "a.mesh", "a.html", "a.svg", "a.png"}) {
    const bool report = name == "a.html" || name == "a.svg" || name == "a.png";
    const RunResult run = run_scantet(coarse_sphere({report ? "--report" : "-o", folder / name}), options);
    EXPECT_EQ(run.status, 5) << name << run.err;
    EXPECT_NE(run.err.find(folder / name), std::string::npos) << run.err;
    EXPECT_TRUE(folder.names().empty()) << name;
  }
}

TEST(Output, FullDiskKeepsTheOldFile) {
  const TestFolder folder;
  write_bytes(folder / "a.vtu", "the old mesh");
  RunOptions options;
  options.file_size_limit = 4096;
  EXPECT_EQ(run_scantet(coarse_sphere({"-o", folder / "a.vtu"}), options).status, 5);
  EXPECT_EQ(read_bytes(folder / "a.vtu"), "the old mesh");
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST(Output, TwoRunsGiveTheSameBytes) {
  const TestFolder folder;
  const std::vector<std::string> extensions{".vtu",  ".vtk", ".stl", ".ply", ".mesh", ".msh",
                                            ".msh2", ".inp", ".feb", ".bdf", ".e",    ".med"};
  for (const std::string run : {"1", "2"}) {
    std::vector<std::string> more;
    for (const std::string& extension : extensions) more.insert(more.end(), {"-o", folder / (run + extension)});
    ASSERT_EQ(run_scantet(coarse_sphere(more)).status, 0);
  }
  for (const std::string& extension : extensions) {
    EXPECT_EQ(read_bytes(folder / ("1" + extension)), read_bytes(folder / ("2" + extension))) << extension;
  }
  for (const std::string run : {"1", "2"}) {  // of one mesh: no report of a run says the same time twice
    ASSERT_EQ(
        run_scantet({"report", "1.vtu", "1.msh", "--report", run + ".svg", "--report", run + ".png"}, {folder.path()})
            .status,
        0);
  }
  for (const char* extension : {".svg", ".png"}) {
    EXPECT_EQ(read_bytes(folder / (std::string("1") + extension)), read_bytes(folder / (std::string("2") + extension)));
  }
}

TEST(Output, StandardOutputThatCannotBeWrittenIsReported) {
  const std::string command = std::string(SCANTET_EXECUTABLE) + " plugins > /dev/full 2> /dev/null";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 5);  // output.stdout
}

}  // namespace
}  // namespace scantet
