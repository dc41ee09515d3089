// What is refused, with the code and a word on why.
#include <gtest/gtest.h>
#include <openvdb/points/PointConversion.h>

#include <fstream>
#include <limits>

#include "scantet/base/error.h"
#include "vdb_domain.h"
#include "vdb_files.h"

namespace scantet {
namespace {

const test::TemporaryFile& file() {
  static const test::TemporaryFile one("bad.vdb");
  return one;
}

void expect_refused(const std::string& code, const std::string& says, const std::optional<std::string>& grid = {},
                    const LevelSetSettings& settings = {0.5, InsideSide::above, {}}) {
  try {
    vdb::make_domain(vdb::read_grid(file().path(), grid), settings);
    ADD_FAILURE() << "taken, not refused as " << code << ", " << says;
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.code(), code) << what;
    EXPECT_EQ(error.fault(), code.starts_with("usage") ? Fault::usage : Fault::input);
    EXPECT_NE(what.find(says), std::string::npos) << what;
    EXPECT_FALSE(error.remedy().empty()) << what;
  }
}

void put(const openvdb::GridPtrVec& grids) {
  test::write_grids(file().path(), grids);
}

openvdb::FloatGrid::Ptr block(float value, const openvdb::Coord& at = {}) {
  openvdb::initialize();
  auto grid = openvdb::FloatGrid::create(0);
  grid->fill(openvdb::CoordBBox::createCube(at, 5), value);
  grid->setName("block");
  return grid;
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put_bytes(const std::string& bytes) {
  std::ofstream(file().path(), std::ios::binary) << bytes;
}

TEST(VdbFile, WhatIsNoVdbFileIsRefused) {
  std::filesystem::remove(file().path());
  expect_refused("input.not_found", "no such file");
  put_bytes("");
  expect_refused("input.empty", "empty");
  put_bytes("a text with another name");
  expect_refused("input.format", "not a .vdb file");
  put_bytes(" BDV");
  expect_refused("input.format", "not a .vdb file");
}

TEST(VdbFile, ATruncatedFileIsRefusedWhereverItEnds) {
  put({test::sphere_grid()});
  const std::string whole = bytes_of(file().path());
  for (std::size_t length = 8; length < whole.size(); length += length < 400 ? 7 : 5003) {
    SCOPED_TRACE(length);
    put_bytes(whole.substr(0, length));
    expect_refused("input.corrupt", "damaged or not complete", {}, {0, InsideSide::below, {}});
  }
}

// A length in the head that is not to be believed, above all.
TEST(VdbFile, ADamagedHeadIsRefusedOrDoesNotMatter) {
  put({block(1)});
  const std::string whole = bytes_of(file().path());
  int longer = 0;
  for (std::size_t place = 56; place < 200; ++place) {
    SCOPED_TRACE(place);
    std::string bytes = whole;
    bytes[place] = static_cast<char>(~bytes[place]);
    put_bytes(bytes);
    try {
      vdb::read_grid(file().path(), std::nullopt);
    } catch (const Error& error) {
      const std::string what = error.what();
      EXPECT_EQ(error.fault(), Fault::input) << what;
      EXPECT_EQ(what.find("memory"), std::string::npos) << what;
      longer += what.find("longer than the file") != std::string::npos ? 1 : 0;
    }
  }
  EXPECT_GT(longer, 20);
}

TEST(VdbFile, ANewerVersionIsRefused) {
  put({block(1)});
  std::string bytes = bytes_of(file().path());
  bytes[8] = '\x7F';
  bytes[9] = '\x7F';
  put_bytes(bytes);
  expect_refused("input.corrupt", "newer");
}

TEST(VdbFile, GridsThatAreNoScalarFieldsAreListed) {
  put({});
  expect_refused("input.grid", "no grid in it");
  auto vectors = openvdb::Vec3SGrid::create();
  vectors->setName("v");
  vectors->tree().setValue(openvdb::Coord(), openvdb::Vec3f(1));
  const auto transform = openvdb::math::Transform::createLinearTransform(1);
  const auto points = openvdb::points::createPointDataGrid<openvdb::points::NullCodec, openvdb::points::PointDataGrid>(
      std::vector<openvdb::Vec3s>{{1, 2, 3}}, *transform);
  points->setName("dots");
  put({vectors, points});
  expect_refused("input.grid", "dots (ptdataidx32), v (vec3s)");
  expect_refused("input.grid", "no grid of a scalar type named dots", "dots");
}

TEST(VdbFile, TheGridIsChosenByName) {
  auto other = block(2);
  other->setName("other");
  put({block(1), other});
  expect_refused("usage.grid", "choose one of block (float), other (float)");
  expect_refused("usage.grid", "no grid named heat", "heat");
  EXPECT_EQ(vdb::read_grid(file().path(), "other").max_value, 2);
  EXPECT_EQ(vdb::read_grid(file().path(), "block").max_value, 1);
  auto vectors = openvdb::Vec3SGrid::create();
  put({vectors, other});
  EXPECT_EQ(vdb::read_grid(file().path(), std::nullopt).head.name, "other") << "the only scalar one";
}

TEST(VdbFile, ValuesThatAreNotFiniteAreRefused) {
  const auto grid = block(1);
  grid->tree().setValue(openvdb::Coord(2, 3, 4), std::numeric_limits<float>::quiet_NaN());
  put({grid});
  expect_refused("input.nan", "1 values are not finite, the first at index (2, 3, 4)");
  put({block(std::numeric_limits<float>::infinity())});
  expect_refused("input.nan", "not finite");
  put({openvdb::FloatGrid::create(std::numeric_limits<float>::quiet_NaN())});
  expect_refused("input.nan", "not finite");
}

TEST(VdbFile, GridsWithoutASurfaceAreRefused) {
  auto empty = openvdb::FloatGrid::create(0);
  put({empty});
  expect_refused("input.grid", "nothing in it but its background");
  put({block(1)});
  expect_refused("input.level", "nothing inside", {}, {1.5, InsideSide::above, {}});
  expect_refused("input.level", "not a number", {}, {std::nan(""), InsideSide::above, {}});
  expect_refused("input.background", "0, is not outside", {}, {0.5, InsideSide::below, {}});
  expect_refused("input.background", "0, is not outside", {}, {0, InsideSide::above, {}});
}

TEST(VdbFile, TransformsThatAreNotAffineAreRefused) {
  const auto grid = block(1);
  grid->setTransform(
      openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(9)), 0.5, 10));
  put({grid});
  expect_refused("input.frame", "frustum");
}

TEST(VdbFile, ABoxThatIsTooLargeIsRefused) {
  const auto grid = block(1);
  grid->tree().setValue(openvdb::Coord(0, 2'000'000'000, 0), 1);
  grid->tree().setValue(openvdb::Coord(0, -2'000'000'000, 0), 1);
  put({grid});
  expect_refused("input.too_large", "4000000001 voxels along y");
}

}  // namespace
}  // namespace scantet
