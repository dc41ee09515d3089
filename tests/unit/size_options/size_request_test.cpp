#include "scantet/size_options/size_request.h"

#include <gtest/gtest.h>

#include "scantet/base/error.h"
#include "scantet/size_options/size_plan.h"

namespace scantet {
namespace {

TEST(SizeRequest, TellsTheKindsApart) {
  using Kind = SizeRequest::Kind;
  EXPECT_EQ(read_size("--size", "").kind, Kind::unset);
  EXPECT_EQ(read_size("--size", "auto").kind, Kind::automatic);
  EXPECT_EQ(read_size("--size", "2.5").kind, Kind::number);
  EXPECT_EQ(read_size("--size", "2.5").size_mm, 2.5);
  EXPECT_EQ(read_size("--size", "2.5 + d").kind, Kind::source);
  EXPECT_NE(read_size("--size", "2.5 + d").source, nullptr);
  EXPECT_EQ(read_size("--size", "/").image, "/");
}

TEST(SizeRequest, SaysThatAFileIsMissing) {
  try {
    read_size("job.json: \"size\"", "folder/sizes.nii.gz");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "usage.size");
    EXPECT_NE(std::string(error.what()).find("job.json: \"size\": folder/sizes.nii.gz: no such file"),
              std::string::npos)
        << error.what();
  }
}

TEST(SizePlan, ReadsTheSizesOfRegions) {
  SizeOptions options;
  options.region_sizes = {"2=1.5", "7=3"};
  EXPECT_EQ(plan_sizes(options).regions, (std::map<Region, double>{{2, 1.5}, {7, 3}}));
  for (const char* bad : {"2", "2=", "=1", "0=1", "2=-1", "2=inf", "2=1mm", "99999999999=1", "a="}) {
    options.region_sizes = {bad};
    EXPECT_THROW(plan_sizes(options), Error) << bad;
  }
  options.region_sizes = {"2=1", "2=3"};
  EXPECT_THROW(plan_sizes(options), Error);
  options.region_sizes = {"left lung=2", "a=b=3", "4=1"};
  EXPECT_EQ(plan_sizes(options).named_regions, (std::map<std::string, double>{{"left lung", 2}, {"a=b", 3}}));
}

}  // namespace
}  // namespace scantet
