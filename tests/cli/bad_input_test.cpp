// Inputs that cannot be meshed: status 3, one line that names the file and what is wrong, a hint, nothing left behind.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "run_process.h"

namespace scantet {
namespace {

struct Header {
  std::string type = "float";
  std::string sizes = "8 8 8";
  std::string more;  // further fields, each with its line break
};

std::string nrrd_header(const Header& header) {
  const auto dimension = std::to_string(1 + std::count(header.sizes.begin(), header.sizes.end(), ' '));
  return "NRRD0004\ntype: " + header.type + "\ndimension: " + dimension + "\nsizes: " + header.sizes +
         "\nendian: little\nencoding: raw\n" + header.more + "\n";
}

// Values of a ball in a grid of 8 x 8 x 8, or whatever `fill` makes of them.
template <class Fill>
std::string voxels(std::size_t count, Fill fill) {
  std::string bytes(count * sizeof(float), '\0');
  for (std::size_t i = 0; i < count; ++i) {
    const float value = fill(i);
    std::memcpy(bytes.data() + i * sizeof(float), &value, sizeof(float));
  }
  return bytes;
}

float ball(std::size_t index) {
  const auto at = [](std::size_t i) { return static_cast<float>(i % 8) - 3.5f; };
  return 3.f - std::hypot(at(index), at(index / 8), at(index / 64));
}

std::string good_scan() {
  return nrrd_header({}) + voxels(512, ball);
}

void expect_input_error(const std::string& file, const std::string& bytes, const std::string& says,
                        std::vector<std::string> options = {"--level", "0"}) {
  for (const std::string command : {"mesh", "info"}) {
    const TestFolder folder;
    write_bytes(folder / file, bytes);
    std::vector<std::string> arguments{command, file};
    arguments.insert(arguments.end(), options.begin(), options.end());
    if (command == "mesh") arguments.insert(arguments.end(), {"-o", "out.vtu", "--report", "out.json"});
    const RunResult run = run_scantet(arguments, {folder.path()});
    EXPECT_EQ(run.status, 3) << file << ": " << run.err;
    EXPECT_EQ(run.out, "") << file;
    EXPECT_EQ(run.err.rfind("scantet: error: ", 0), 0u) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << "an error and a hint: " << run.err;
    EXPECT_NE(run.err.find("scantet: hint: "), std::string::npos) << run.err;
    const std::string line = run.err.substr(0, run.err.find('\n'));
    EXPECT_NE(line.find(file), std::string::npos) << "does not name the file: " << line;
    EXPECT_NE(line.find(says), std::string::npos) << "does not say " << says << ": " << line;
    EXPECT_EQ(folder.names(), std::vector<std::string>{file});
  }
}

TEST(BadInput, TheScanTheOthersAreMadeFromIsGood) {
  const TestFolder folder;
  write_bytes(folder / "good.nrrd", good_scan());
  const RunResult run = run_scantet({"mesh", folder / "good.nrrd", "--level", "0", "-o", folder / "out.vtu"});
  EXPECT_EQ(run.status, 0) << run.err;
}

TEST(BadInput, MissingFile) {
  const TestFolder folder;
  const RunResult run = run_scantet({"mesh", "absent.nrrd", "--level", "1", "-o", "out.vtu"}, {folder.path()});
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("absent.nrrd"), std::string::npos) << run.err;
  EXPECT_TRUE(folder.names().empty());
}

TEST(BadInput, EmptyFile) {
  expect_input_error("empty.nrrd", "", "empty");
}

TEST(BadInput, NotAnImage) {
  expect_input_error("notes.txt", "these are notes\n", "format");
  expect_input_error("noise.nrrd", std::string("\x7f\x45LF\0\1\2\3garbage", 15), "");
  expect_input_error("noise.nii.gz", std::string("\x1f\x8b\x08\0\0\0\0\0garbage", 15), "");
}

TEST(BadInput, EmptyFolder) {
  const TestFolder folder;
  const RunResult run = run_scantet({"mesh", folder.path(), "--level", "1"});
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_NE(run.err.find(folder.path()), std::string::npos) << run.err;
}

TEST(BadInput, TruncatedVoxels) {
  expect_input_error("cut.nrrd", good_scan().substr(0, 1000), "");
  const std::string whole = read_bytes(sample("islands.nii.gz"));
  expect_input_error("cut.nii.gz", whole.substr(0, whole.size() / 2), "", {"--level", "60"});
}

TEST(BadInput, DamagedHeader) {
  expect_input_error("bad.nrrd", "NRRD0004\ntype: float\ndimension: three\nsizes: 8 8 8\n\n", "");
  expect_input_error("cut.nrrd", "NRRD0004\ntype: flo", "");
}

TEST(BadInput, NotFinite) {
  const auto with = [](float odd) {
    return nrrd_header({}) + voxels(512, [odd](std::size_t i) { return i == 100 ? odd : ball(i); });
  };
  expect_input_error("nan.nrrd", with(std::numeric_limits<float>::quiet_NaN()), "NaN");
  expect_input_error("inf.nrrd", with(std::numeric_limits<float>::infinity()), "inf");
  expect_input_error("allnan.nrrd",
                     nrrd_header({}) + voxels(512, [](std::size_t) { return std::numeric_limits<float>::quiet_NaN(); }),
                     "NaN");
}

TEST(BadInput, Constant) {
  expect_input_error("flat.nrrd", nrrd_header({}) + voxels(512, [](std::size_t) { return 7.f; }), "7");
}

TEST(BadInput, WrongDimension) {
  expect_input_error("two.nrrd", nrrd_header({"float", "8 8", ""}) + voxels(64, ball), "");
  expect_input_error("four.nrrd", nrrd_header({"float", "8 8 8 3", ""}) + voxels(1536, ball), "");
  expect_input_error("thin.nrrd", nrrd_header({"float", "8 8 1", ""}) + voxels(64, ball), "");
}

TEST(BadInput, SeveralValuesAVoxel) {
  expect_input_error(
      "rgb.nrrd", nrrd_header({"float", "3 8 8 8", "kinds: vector domain domain domain\n"}) + voxels(1536, ball), "");
}

TEST(BadInput, SizeThatCannotBe) {
  expect_input_error("huge.nrrd", nrrd_header({"float", "2000000 2000000 2000000", ""}) + "x", "");
  expect_input_error("negative.nrrd", nrrd_header({"float", "8 -8 8", ""}) + voxels(512, ball), "");
}

TEST(BadInput, FlatFrame) {
  const std::string axes = "space: left-posterior-superior\nspace directions: (1,0,0) (1,0,0) (0,0,1)\n";
  expect_input_error("flat_frame.nrrd", nrrd_header({"float", "8 8 8", axes}) + voxels(512, ball), "");
}

TEST(BadInput, LevelOutOfRange) {
  for (const char* level : {"1e6", "-1e6"}) {
    const TestFolder folder;
    const RunResult run =
        run_scantet({"mesh", sample("sphere.nrrd"), "--level", level, "-o", "out.vtu"}, {folder.path()});
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_NE(run.err.find("level"), std::string::npos) << run.err;
    EXPECT_TRUE(folder.names().empty());
  }
}

TEST(BadInput, MeshFiles) {
  for (const std::string command : {"report", "convert"}) {
    const TestFolder folder;
    write_bytes(folder / "bad.vtu", "<VTKFile");
    write_bytes(folder / "empty.msh", "");
    for (const char* file : {"bad.vtu", "empty.msh", "absent.vtk"}) {
      std::vector<std::string> arguments{command, file};
      if (command == "convert") arguments.emplace_back("out.inp");
      const RunResult run = run_scantet(arguments, {folder.path()});
      EXPECT_EQ(run.status, 3) << command << file << run.err;
      EXPECT_NE(run.err.find(file), std::string::npos) << run.err;
    }
    EXPECT_EQ(folder.names().size(), 2u);
  }
}

// Nothing is opened that could keep the program waiting.
TEST(BadInput, PipesAndDevices) {
  const TestFolder folder;
  for (const char* name :
       {"pipe.nrrd", "pipe.mhd", "pipe.nhdr", "pipe.off", "pipe.xyz", "pipe.vdb", "pipe.vtu", "pipe.json", "pipe"}) {
    ASSERT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
    for (const char* command : {"info", "mesh", "report", "convert"}) {
      std::vector<std::string> arguments{command, name};
      if (command == std::string("convert")) arguments.emplace_back("out.inp");
      if (command == std::string("mesh")) arguments.insert(arguments.end(), {"--level", "1"});
      const RunResult run = run_scantet(arguments, {.folder = folder.path(), .timeout_s = 20});
      EXPECT_EQ(run.status, 3) << command << name << run.err;
      EXPECT_NE(run.err.find("is a pipe"), std::string::npos) << run.err;
      EXPECT_NE(run.err.find("hint: write what comes from it to a file first"), std::string::npos) << run.err;
    }
  }
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"info", "/dev/zero"},
                                             {"verify", "--certificate", "pipe.json"},
                                             {"diff", "pipe.vtu", "pipe.vtu"},
                                             {"verify", "pipe.vtu", "--against", "pipe.mhd", "--level", "1"},
                                             {"mesh", sample("sphere.nrrd"), "--level", "100", "--config", "pipe.json"},
                                             {"mesh", sample("sphere.nrrd"), "--level", "100", "--size", "pipe.nrrd"},
                                             {"mesh", sample("sphere.nrrd"), "--level", "100", "--plugin", "pipe"}}) {
    const RunResult run = run_scantet(words, {.folder = folder.path(), .timeout_s = 20});
    EXPECT_EQ(run.status, words.size() > 5 && words[4] == "--plugin" ? 2 : 3) << run.err;
  }
  EXPECT_EQ(folder.names().size(), 9U);
}

TEST(BadInput, MeshTooLargeToMeasure) {
  const TestFolder folder;
  write_bytes(folder / "large.mesh",
              "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n1e300 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
              "Tetrahedra\n1\n1 2 3 4 1\nEnd\n");
  const RunResult run = run_scantet({"report", "large.mesh", "--report", "a.html"}, {folder.path()});
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_NE(run.err.find("large.mesh: a coordinate of 1e+300 mm"), std::string::npos) << run.err;
  EXPECT_EQ(folder.names().size(), 1U);
}

TEST(BadInput, SizesLargerThanTheObject) {
  for (const char* size : {"1e9", "1e9 + 0*x"}) {
    const TestFolder folder;
    const RunResult run = run_scantet(
        {"mesh", sample("sphere.nrrd"), "--level", "127.5", "--size", size, "-o", "a.vtu"}, {folder.path()});
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_NE(run.err.find("sphere.nrrd: no tetrahedron of size"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("choose a smaller --size"), std::string::npos) << run.err;
    EXPECT_TRUE(folder.names().empty());
  }
}

}  // namespace
}  // namespace scantet
