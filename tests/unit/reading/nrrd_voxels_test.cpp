// Headers that ask for more voxels than there are, in every encoding, beside those that ask for what is there.
#include <zlib.h>

#include <string>

#include "scan_files.h"
#include "scantet/reading/nrrd_voxels_impl.h"

namespace scantet {
namespace {

using namespace test;

std::string header(const std::string& encoding, const std::string& more = "") {
  return "NRRD0004\ntype: short\ndimension: 3\nsizes: 10 10 10\nEncoding: " + encoding + "\nendian: little\n" + more;
}

std::string packed(const std::string& bytes, const TempFolder& folder) {
  const std::string path = folder / "packed";
  const gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void expect_present(const std::string& path) {
  EXPECT_NO_THROW(check_nrrd_voxels(path, 2000, 1000)) << path;
}

void expect_missing(const std::string& path, std::uint64_t bytes = 2001) {
  try {
    check_nrrd_voxels(path, bytes, bytes / 2 + 1);
    ADD_FAILURE() << path << " passes";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "input.corrupt");
    EXPECT_NE(std::string(error.what()).find("its header asks for"), std::string::npos) << error.what();
  }
}

TEST(NrrdVoxels, AttachedAndDetachedVoxelsAreCounted) {
  const TempFolder folder;
  std::string text;
  for (int n = 0; n < 1000; ++n) text += n == 0 ? "7" : " 7";
  const std::string bytes(2000, 'x');
  const std::string half = packed(bytes.substr(0, 1000), folder);
  const std::vector<std::pair<std::string, std::string>> cases{
      {"raw", bytes},
      {"gzip", packed(bytes, folder)},
      {"gz", half + half},  // two members: the length at the end is of one
      {"gzip", packed(bytes, folder) + "more behind it"},
      {"ascii", text},
      {"hex", bytes + bytes}};
  for (const auto& [encoding, voxels] : cases) {
    write_text(folder / "a.nrrd", header(encoding) + "\n" + voxels);
    expect_present(folder / "a.nrrd");
    expect_missing(folder / "a.nrrd");
    write_text(folder / "voxels.bin", voxels);
    write_text(folder / "a.nhdr", header(encoding, "data file: voxels.bin\n"));
    expect_present(folder / "a.nhdr");
    expect_missing(folder / "a.nhdr");
  }
}

TEST(NrrdVoxels, LengthAtTheEndDoesNotHideWhatCannotBe) {
  const TempFolder folder;
  std::string forged = packed(std::string(2000, 'x'), folder);
  forged.replace(forged.size() - 4, 4, std::string("\0\0\0\x40", 4));  // 2^30
  write_text(folder / "a.nrrd", header("gzip") + "\n" + forged);
  expect_missing(folder / "a.nrrd", std::uint64_t{1} << 30);
}

TEST(NrrdVoxels, VoxelsInNoFileAreLeftToTheLibrary) {
  const TempFolder folder;
  write_text(folder / "a.nhdr", header("raw", "data file: none.raw\n"));
  expect_present(folder / "a.nhdr");
}

TEST(NrrdVoxels, SeveralFilesCountTogether) {
  const TempFolder folder;
  for (const char* files : {"s%02d.raw 1 2 1\n", "s%02d.raw 2 1 -1\n", "LIST\ns01.raw\ns02.raw\n"}) {
    write_text(folder / "s01.raw", std::string(1200, 'x'));
    write_text(folder / "s02.raw", std::string(800, 'x'));
    write_text(folder / "a.nhdr", header("raw", std::string("data file: ") + files));
    expect_present(folder / "a.nhdr");
    write_text(folder / "s02.raw", std::string(799, 'x'));
    expect_missing(folder / "a.nhdr");
    std::filesystem::remove(folder / "s02.raw");
    expect_missing(folder / "a.nhdr");
  }
  write_text(folder / "a.nhdr", header("gzip", "data file: LIST\ns01.raw\n"));
  expect_missing(folder / "a.nhdr", std::uint64_t{1200} * 1032 + 1);
}

TEST(NrrdVoxels, ShortFilesTakeNoMemory) {
  const TempFolder folder;
  std::string head = header("raw");
  head.replace(head.find("10 10 10"), 8, "2000 2000 1000");
  write_text(folder / "a.nrrd", head + "\n" + std::string(100, 'x'));
  EXPECT_NE(expect_refused(folder / "a.nrrd", "input.corrupt").find("8000000000 bytes"), std::string::npos);
  write_text(folder / "a.vtk",
             "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2000 2000 1000\n"
             "SPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA 4000000000\nSCALARS s short\nLOOKUP_TABLE default\nxxxx");
  EXPECT_NE(expect_refused(folder / "a.vtk", "input.corrupt").find("8000000000 bytes"), std::string::npos);
}

}  // namespace
}  // namespace scantet
