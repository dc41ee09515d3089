// INRIMAGE files, written by hand as their header is text: types, byte orders, packed ones, frames, and what is
// refused.
#include <zlib.h>

#include "scan_files.h"

namespace scantet {
namespace {

using namespace test;

const Grid kGrid{{7, 6, 5}, {Vec{0.5, 0, 0}, Vec{0, 0.75, 0}, Vec{0, 0, 2}}, {0, 0, 0}};

/// 256 bytes. more: further lines.
std::string inr_head(const std::string& type, int bits, const std::string& more = "",
                     const std::string& order = "decm") {
  std::string head = "#INRIMAGE-4#{\nXDIM=7\nYDIM=6\nZDIM=5\nVDIM=1\nTYPE=" + type +
                     "\nPIXSIZE=" + std::to_string(bits) + " bits\nCPU=" + order + "\nVX=0.5\nVY=0.75\nVZ=2\n" + more;
  head.resize(252, '\n');
  return head + "##}\n";
}

template <class T>
std::string bytes_of_values(std::vector<T> values, bool big_endian) {
  for (T& value : values) {
    auto* raw = reinterpret_cast<char*>(&value);
    if (big_endian) std::reverse(raw, raw + sizeof(T));
  }
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

void write_packed(const std::string& path, const std::string& bytes) {
  const gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
}

template <class T>
class InrTypes : public testing::Test {};
using Types = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t,
                             std::int64_t, std::uint64_t, float, double>;
TYPED_TEST_SUITE(InrTypes, Types);

TYPED_TEST(InrTypes, AreReadInBothByteOrders) {
  const TempFolder folder;
  const auto values = pattern<TypeParam>(kGrid);
  const std::string type = std::is_floating_point_v<TypeParam> ? "float"
                           : std::is_signed_v<TypeParam>       ? "signed fixed"
                                                               : "unsigned fixed";
  for (const bool big_endian : {false, true}) {
    const std::string path = folder / (big_endian ? "big.inr" : "little.inr");
    write_text(path, inr_head(type, 8 * sizeof(TypeParam), "", big_endian ? "sun" : "decm") +
                         bytes_of_values(values, big_endian));
    EXPECT_EQ(can_read_scan(path), 100);
    const Scan scan = read(path);
    EXPECT_EQ(scan.format, "INRIMAGE");
    expect_voxels(scan, values);
    expect_frame(scan, kGrid);
  }
}

TEST(InrImage, PackedWithAnOffset) {
  const TempFolder folder;
  const auto values = pattern<std::int16_t>(kGrid);
  write_packed(folder / "a.inr.gz",
               inr_head("signed fixed", 16, "TX=-12.5\nTY=30.25\nTZ=7\n#a remark\n") + bytes_of_values(values, false));
  const Scan scan = read(folder / "a.inr.gz");
  expect_voxels(scan, values);
  Grid moved = kGrid;
  moved.origin = {-12.5, 30.25, 7};
  expect_frame(scan, moved);
}

TEST(InrImage, WhatIsNoScanIsRefused) {
  const TempFolder folder;
  const std::string voxels = bytes_of_values(pattern<std::uint8_t>(kGrid), false);
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& code) {
    std::string head = inr_head("unsigned fixed", 8);
    head.replace(head.find(from), from.size(), to);
    write_text(folder / "a.inr", head + voxels);
    expect_refused(folder / "a.inr", code);
  };
  refused("VDIM=1", "VDIM=3", "input.pixel_type");
  refused("fixed\nPIXSIZE=8", "fixed\nPIXSIZE=7", "input.corrupt");
  refused("TYPE=unsigned fixed", "TYPE=float", "input.pixel_type");
  refused("ZDIM=5", "ZDIM=1", "input.dimension");
  refused("ZDIM=5", "ZDIM=6", "input.corrupt");
  refused("ZDIM=5", "ZDIM=0", "input.corrupt");
  refused("ZDIM=5", "ZDIM=-5", "input.dimension");
  refused("ZDIM=5", "ZDIM=5000000000", "input.too_large");
  refused("ZDIM=5", "ZDIM=1e30", "input.dimension");  // the 1 is taken
  refused("VX=0.5", "VX=nan", "input.corrupt");
  refused("VX=0.5", "VX=0", "input.corrupt");
  refused("VZ=2\n", "VZ=2\nRX=1\n", "input.frame");
  refused("CPU=decm", "CPU=none", "input.corrupt");
}

TEST(InrImage, CutShortOrDamagedIsRefused) {
  const TempFolder folder;
  const std::string whole = inr_head("unsigned fixed", 8) + bytes_of_values(pattern<std::uint8_t>(kGrid), false);
  for (std::size_t length = 13; length < whole.size(); length += 31) {
    write_text(folder / "cut.inr", whole.substr(0, length));
    expect_refused(folder / "cut.inr", "input.corrupt");
  }
  write_packed(folder / "whole.inr.gz", whole);
  std::string packed = bytes_of(folder / "whole.inr.gz");
  write_text(folder / "cut.inr.gz", packed.substr(0, packed.size() - 20));
  expect_refused(folder / "cut.inr.gz", "input.corrupt");
  packed[packed.size() - 8] ^= 1;  // the checksum
  write_text(folder / "sum.inr.gz", packed);
  expect_refused(folder / "sum.inr.gz", "input.corrupt");
}

}  // namespace
}  // namespace scantet
