#include "scantet/field/scan_from_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "scantet/base/error.h"
#include "scantet/image/level_set.h"

namespace scantet {
namespace {

constexpr std::array<int, 3> kRampSize{2, 3, 4};

template <class Act>
std::string code_of(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.code();
  }
  return "";
}

std::vector<std::int16_t> ramp(std::size_t count = 24) {
  std::vector<std::int16_t> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<std::int16_t>(i) - 5;
  return values;
}

TEST(ScanFromMemory, BorrowsWhatTheCallerKeeps) {
  const std::vector<std::int16_t> values = ramp();
  const Frame frame({Vec{0, 2, 0}, Vec{-3, 0, 0}, Vec{0, 0, 4}}, {10, 20, 30});
  const Scan scan = make_scan(values.data(), kRampSize, frame);
  EXPECT_EQ(std::get<const std::int16_t*>(scan.voxels), values.data());
  EXPECT_EQ(scan.owner, nullptr);
  EXPECT_EQ(scan.size, kRampSize);
  EXPECT_EQ(scan.min_value, -5);
  EXPECT_EQ(scan.max_value, 18);
  EXPECT_EQ(scan.pixel_type, "int16");
  EXPECT_EQ(scan.format, "memory");
  EXPECT_EQ(scan.frame.to_world({1, 0, 0}), (Point{10, 22, 30}));
}

TEST(ScanFromMemory, KeepsItsOwnerAsLongAsADomainOfIt) {
  auto values = std::make_shared<std::vector<float>>(27, 0.F);
  (*values)[13] = 1;  // the voxel in the middle
  const std::weak_ptr<std::vector<float>> watched = values;
  std::unique_ptr<Domain> domain;
  {
    const Scan scan = make_scan(values->data(), {3, 3, 3}, Frame(), values);
    values.reset();
    domain = make_level_set(scan, {.level = 0.5});
  }
  EXPECT_FALSE(watched.expired());
  EXPECT_EQ(domain->region_at({1, 1, 1}), 1);
  domain.reset();
  EXPECT_TRUE(watched.expired());
}

TEST(ScanFromMemory, OwnsValuesThatAreGivenToIt) {
  std::vector<std::int16_t> values = ramp();
  const std::int16_t* const place = values.data();
  const Scan scan = make_scan(std::move(values), kRampSize, Frame());
  EXPECT_EQ(std::get<const std::int16_t*>(scan.voxels), place);
  EXPECT_NE(scan.owner, nullptr);
  EXPECT_EQ(std::get<const std::int16_t*>(scan.voxels)[23], 18);
}

TEST(ScanFromMemory, KnowsTheTenTypes) {
  const auto type_of = [](auto value) {
    return make_scan(std::vector{value, decltype(value)(1), value, value, value, value, value, value}, {2, 2, 2}, {})
        .pixel_type;
  };
  EXPECT_EQ(type_of(std::int8_t{0}), "int8");
  EXPECT_EQ(type_of(std::uint8_t{0}), "uint8");
  EXPECT_EQ(type_of(std::uint16_t{0}), "uint16");
  EXPECT_EQ(type_of(std::int32_t{0}), "int32");
  EXPECT_EQ(type_of(std::uint32_t{0}), "uint32");
  EXPECT_EQ(type_of(std::int64_t{0}), "int64");
  EXPECT_EQ(type_of(std::uint64_t{0}), "uint64");
  EXPECT_EQ(type_of(0.F), "float");
  EXPECT_EQ(type_of(0.0), "double");
}

TEST(ScanFromMemory, RefusesWhatMakesNoScan) {
  const std::vector<std::int16_t> values = ramp();
  const std::int16_t* const nothing = nullptr;
  EXPECT_EQ(code_of([&] { make_scan(nothing, kRampSize, Frame()); }), "input.pixel_type");
  EXPECT_EQ(code_of([&] { make_scan(values.data(), {24, 1, 1}, Frame()); }), "input.dimension");
  EXPECT_EQ(code_of([&] { make_scan(values.data(), {-2, 3, -4}, Frame()); }), "input.dimension");
  EXPECT_EQ(code_of([&] { make_scan(ramp(23), kRampSize, Frame()); }), "input.dimension");
  EXPECT_EQ(code_of([&] { make_scan(std::vector<std::int16_t>(24, 7), kRampSize, Frame()); }), "input.constant");
  std::vector<double> holey(24, 1.0);
  holey[7] = std::numeric_limits<double>::quiet_NaN();
  holey[8] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(code_of([&] { make_scan(holey, kRampSize, Frame()); }), "input.nan");
  try {
    make_scan(holey, kRampSize, Frame());
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("2 voxels of the scan (memory)"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("index (1, 0, 1)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace scantet
