// Outputs are judged before the work: extension, folder, name clashes; and nothing is left behind by the check.
#include "scantet/app/outputs.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "scantet/base/error.h"

namespace scantet {
namespace {

class Outputs : public testing::Test {
 protected:
  std::string folder_ = testing::TempDir() + std::to_string(getpid()) + "_scantet_outputs_" +
                        testing::UnitTest::GetInstance()->current_test_info()->name();
  void SetUp() override { std::filesystem::create_directory(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string in_folder(const std::string& name) const { return folder_ + "/" + name; }
  std::string code(const std::vector<std::string>& meshes, const std::vector<std::string>& reports = {},
                   const std::vector<std::string>& inputs = {}) const {
    try {
      check_outputs(meshes, reports, inputs);
    } catch (const Error& error) {
      EXPECT_FALSE(error.remedy().empty()) << error.what();
      return error.code();
    }
    return "fine";
  }
};

TEST_F(Outputs, GoodOnesPassAndNothingIsLeft) {
  EXPECT_EQ(
      code({in_folder("a.vtu"), in_folder("a.VTK"), in_folder("b.msh")},
           {in_folder("r.json"), in_folder("r.csv"), in_folder("r.html"), in_folder("r.SVG"), in_folder("r.png")}),
      "fine");
  EXPECT_EQ(code({}), "fine");
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(Outputs, ExistingFilesKeepTheirContent) {
  std::ofstream(in_folder("a.vtu")) << "precious";
  EXPECT_EQ(code({in_folder("a.vtu")}), "fine");
  std::string content;
  std::ifstream(in_folder("a.vtu")) >> content;
  EXPECT_EQ(content, "precious");
}

TEST_F(Outputs, ExtensionsAreChecked) {
  EXPECT_EQ(code({in_folder("a.vtx")}), "usage.format");
  EXPECT_EQ(code({in_folder("a")}), "usage.format");
  EXPECT_EQ(code({in_folder("a.json")}), "usage.format") << "a report is no mesh";
  EXPECT_EQ(code({}, {in_folder("a.vtu")}), "usage.format") << "a mesh is no report";
}

TEST_F(Outputs, FoldersAreChecked) {
  EXPECT_EQ(code({in_folder("missing/a.vtu")}), "output.cannot_write");
  EXPECT_EQ(code({"/proc/a.vtu"}), "output.cannot_write");
  std::filesystem::create_directory(in_folder("a.vtu"));
  EXPECT_EQ(code({in_folder("a.vtu")}), "output.cannot_write") << "a folder in its place";
}

TEST_F(Outputs, ClashesAreRefused) {
  EXPECT_EQ(code({in_folder("a.vtu"), in_folder("./a.vtu")}), "usage.same_file");
  std::ofstream(in_folder("a.vtk")) << "input";
  EXPECT_EQ(code({in_folder("a.vtk")}, {}, {in_folder("a.vtk")}), "usage.same_file");
  std::filesystem::create_symlink(in_folder("a.vtk"), in_folder("link.vtk"));
  EXPECT_EQ(code({in_folder("link.vtk")}, {}, {in_folder("a.vtk")}), "usage.same_file");
}

TEST_F(Outputs, LinksToWhereNothingIsYetAreFollowed) {
  std::filesystem::create_symlink("target.vtu", in_folder("link.vtu"));
  EXPECT_EQ(code({in_folder("link.vtu"), in_folder("target.vtu")}), "usage.same_file");
  EXPECT_EQ(code({in_folder("link.vtu")}, {}, {in_folder("target.vtu")}), "usage.same_file");
  EXPECT_EQ(code({in_folder("link.vtu"), in_folder("other.vtu")}), "fine");
  EXPECT_TRUE(std::filesystem::is_symlink(in_folder("link.vtu")));
}

TEST_F(Outputs, HardLinksToWhatIsReadAreRefused) {
  std::ofstream(in_folder("sizes.nrrd")) << "read";
  std::filesystem::create_hard_link(in_folder("sizes.nrrd"), in_folder("a.vtu"));
  EXPECT_EQ(code({in_folder("a.vtu")}, {}, {in_folder("sizes.nrrd")}), "usage.same_file");
}

}  // namespace
}  // namespace scantet
