// Headers that made a format library write past its memory, wait for ever or fill the machine: refused, and by us.
#include <sys/stat.h>

#include "scan_files.h"

namespace scantet {
namespace {

using namespace test;

/// A MetaImage header of 10 x 10 x 10 voxels; `more` stands before the name of the voxels.
std::string meta(const std::string& data_file, const std::string& more = "CompressedData = False\n") {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n" + more +
         "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nElementSpacing = 1 1 1\nDimSize = 10 10 10\n"
         "ElementType = MET_SHORT\nElementDataFile = " +
         data_file;
}

std::string refused(const TempFolder& folder, const std::string& name, const std::string& bytes,
                    const std::string& code = "input.corrupt") {
  write_text(folder / name, bytes);
  return expect_refused(folder / name, code);
}

void expect_says(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message << " does not say " << part;
}

TEST(HostileHeader, MetaImagePatternsAndLongWords) {
  const TempFolder folder;
  for (const std::size_t length : {100, 300, 2000, 10'000}) {
    const std::string message = refused(folder, "a.mhd", meta("%d" + std::string(length, 'A')));
    expect_says(message, "ElementDataFile");
  }
  expect_says(refused(folder, "a.mhd", meta(std::string(40'000, 'A'))), "too long");
  for (const char* pattern : {"%s.raw 1 3 1", "%d%d.raw 1 3 1", "%999d.raw 1 3 1", "%n.raw", "%", "a%d.raw 1 1e9 1",
                              "a%d.raw 1 2000000000 1", "a%d.raw 1 3 0", "a%d.raw 1 3 1 7"}) {
    expect_says(refused(folder, "a.mhd", meta(pattern)), "pattern");
  }
  expect_says(refused(folder, "a.mhd", meta("LIST\n" + std::string(90, 'A') + "\n")), "list of files");
}

TEST(HostileHeader, MetaImageNumbers) {
  const TempFolder folder;
  const std::string packed = "CompressedData = True\nCompressedDataSize = ";
  expect_says(refused(folder, "a.mha", meta("LOCAL\nx", packed + "1e308\n")), "1e308");
  expect_says(refused(folder, "a.mha", meta("LOCAL\nx", packed + "9000\n")), "CompressedDataSize of 9000");
  expect_says(refused(folder, "a.mha", meta("LOCAL\nx", "ElementNumberOfChannels = 2000000\n")), "2000000");
  expect_says(refused(folder, "a.mha", meta("LOCAL\nx", "CenterOfRotation = 1 2\n")), "2 numbers instead of 3");
  expect_says(refused(folder, "a.mha", meta("LOCAL\nx", "NDims = 2\n")), "twice");
  expect_says(refused(folder, "a.mha", meta("LOCAL\nx", "Comment = " + std::string(300, 'c') + "\n")), "too long");
  expect_says(refused(folder, "a.mha", "NDims = 3\nDimSize = 3 3 3\n"), "ElementDataFile");
}

TEST(HostileHeader, VoxelsAreBesideTheHeader) {
  const TempFolder folder;
  const std::string nrrd = "NRRD0004\ntype: short\ndimension: 3\nsizes: 10 10 10\nencoding: raw\nendian: little\n";
  for (const char* name : {"/etc/passwd", "../a.raw", "a/../../b.raw"}) {
    expect_says(refused(folder, "a.mhd", meta(name)), "not beside it");
    expect_says(refused(folder, "a.nhdr", nrrd + "data file: " + name + "\n"), "not beside it");
    expect_says(refused(folder, "a.nhdr", nrrd + "data file: LIST\n" + name + "\n"), "not beside it");
  }
  expect_says(refused(folder, "a.mhd", meta("= /etc/passwd")), "separator");
  expect_says(refused(folder, "a.mhd", meta(": = /etc/passwd")), "separator");
  expect_says(refused(folder, "a.mhd", meta("LISTx\n/etc/passwd\n")), "LIST");
  for (const std::string blank : {"\v", "\f", "\r"}) {
    expect_says(refused(folder, "a.mhd", meta("x.raw", blank + "ElementDataFile = /etc/passwd\n")), "control");
  }
  for (const char* pattern : {"%s.raw 1 3 1", "%d%n.raw 1 3 1", "a%03d.raw 1 3 0", "a%03d.raw 1 1e9 1"}) {
    expect_says(refused(folder, "a.nhdr", nrrd + "data file: " + pattern + "\n"), "pattern");
  }
  expect_says(refused(folder, "a.nhdr", nrrd + "type: " + std::string(5000, 'x') + "\n"), "bytes long");
  expect_says(refused(folder, "a.nrrd", nrrd + "# c\rdata file: /etc/passwd\n\n"), "carriage return");
  const std::string comments = "#" + std::string(1000, 'c') + "\n";
  std::string long_head = nrrd;
  while (long_head.size() < (1U << 20)) long_head += comments;
  expect_says(refused(folder, "a.nrrd", long_head + "data file: /etc/passwd\n\n"), "first MiB");
  ASSERT_EQ(mkfifo((folder / "v7.raw").c_str(), 0600), 0);
  refused(folder, "a.mhd", meta("v%d.raw 1 9 1"), "input.not_a_file");
  refused(folder, "a.nhdr", nrrd + "data file: v%d.raw 1 9 1\n", "input.not_a_file");
  ASSERT_EQ(mkfifo((folder / "pipe.raw").c_str(), 0600), 0);
  refused(folder, "a.mhd", meta("pipe.raw"), "input.not_a_file");
  refused(folder, "a.nhdr", nrrd + "data file: pipe.raw\n", "input.not_a_file");
}

TEST(HostileHeader, VoxelsInSeveralFilesAreRead) {
  const TempFolder folder;
  const std::string head = "NDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\nElementDataFile = ";
  write_text(folder / "s1.raw", "abcdefghijkl");
  write_text(folder / "s2.raw", "mnopqrstuvwx");
  for (const char* files : {"LIST\ns1.raw\ns2.raw\n", "s%d.raw 1 2 1\n", "s%d.raw 1 2 1"}) {
    write_text(folder / "a.mhd", head + files);
    const Scan scan = read(folder / "a.mhd");
    EXPECT_EQ(scan.min_value, 'a') << files;
    EXPECT_EQ(scan.max_value, 'x') << files;
  }
}

TEST(HostileHeader, PipesAndDevicesAreRefused) {
  const TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "a.nrrd").c_str(), 0600), 0);
  expect_says(expect_refused(folder / "a.nrrd", "input.not_a_file"), "a pipe");
  expect_says(expect_refused("/dev/zero", "input.not_a_file"), "a device");
  EXPECT_EQ(can_read_scan(folder / "a.nrrd"), 0);
  write_text(folder / "b.hdr", nifti_header({.magic = "ni1"}));
  ASSERT_EQ(mkfifo((folder / "b.img").c_str(), 0600), 0);
  try {
    read(folder / "b.hdr");
    ADD_FAILURE() << "b.hdr was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "input.not_a_file") << error.what();
  }
}

}  // namespace
}  // namespace scantet
