// Which files make up an input, and their checksum.
#include "scantet/io/input_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "scantet/base/error.h"

namespace scantet {
namespace {

class InputFiles : public testing::Test {
 protected:
  std::string folder_ = testing::TempDir() + std::to_string(getpid()) + "_scantet_input_" +
                        testing::UnitTest::GetInstance()->current_test_info()->name();
  void SetUp() override { std::filesystem::create_directory(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string make(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ + "/" + name, std::ios::binary) << content;
    return folder_ + "/" + name;
  }
};

TEST_F(InputFiles, OneFileIsItself) {
  const std::string file = make("a.nrrd", "abc");
  EXPECT_EQ(input_files(file), std::vector<std::string>{file});
  EXPECT_EQ(input_sha256({file}), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad") << "of abc";
}

TEST_F(InputFiles, DetachedHeadersBringTheirVoxels) {
  const std::string raw = make("v.raw", "x");
  const std::string nhdr = make("a.nhdr", "NRRD0004\ndimension: 3\ndata file: v.raw\n");
  const std::string mhd = make("a.mhd", "NDims = 3\r\nElementDataFile = v.raw\r\n");
  const std::string hdr = make("b.hdr", "h");
  const std::string img = make("b.img", "i");
  EXPECT_EQ(input_files(nhdr), (std::vector<std::string>{nhdr, raw}));
  EXPECT_EQ(input_files(mhd), (std::vector<std::string>{mhd, raw}));
  EXPECT_EQ(input_files(hdr), (std::vector<std::string>{hdr, img}));
  EXPECT_EQ(input_files(img), (std::vector<std::string>{hdr, img}));
  const std::string local = make("c.mhd", "ElementDataFile = LOCAL\n");
  EXPECT_EQ(input_files(local), std::vector<std::string>{local});
}

TEST_F(InputFiles, AnyHeaderMayNameVoxelsListedOrByAPattern) {
  const std::string one = make("v1.raw", "x");
  const std::string two = make("v02.raw", "y");
  make("v.raw", "z");
  make("w1.raw", "z");
  using Names = std::vector<std::string>;
  const std::string nrrd = make("a.nrrd", "NRRD0004\ndata file: v1.raw\n\ndata file: w1.raw\n");
  EXPECT_EQ(input_files(nrrd), (Names{nrrd, one}));
  const std::string list = make("b.nhdr", "NRRD0004\ndata file: LIST\nv1.raw\nv02.raw\n");
  EXPECT_EQ(input_files(list), (Names{list, two, one}));
  const std::string pattern = make("c.mha", "NDims = 3\nElementDataFile = v%d.raw 1 9 1\n");
  EXPECT_EQ(input_files(pattern), (Names{pattern, two, one}));
  const std::string hdr = make("d.hdr", "h");
  const std::string img = make("d.img.gz", "i");
  EXPECT_EQ(input_files(hdr), (Names{hdr, img}));
  EXPECT_EQ(input_files(img), (Names{hdr, img}));
}

TEST_F(InputFiles, FoldersAreTheirFilesSorted) {
  const std::string b = make("b.dcm", "2");
  const std::string a = make("a.dcm", "1");
  EXPECT_EQ(input_files(folder_), (std::vector<std::string>{a, b}));
  EXPECT_EQ(input_files(folder_ + ":1.2.840"), (std::vector<std::string>{a, b}));
  const std::string both = input_sha256({a, b});
  EXPECT_EQ(both.size(), 64u);
  make("b.dcm", "3");
  EXPECT_NE(input_sha256({a, b}), both) << "every file counts";
}

TEST_F(InputFiles, UnreadableFilesAreErrors) {
  EXPECT_THROW(input_sha256({folder_ + "/absent"}), Error);
}

}  // namespace
}  // namespace scantet
