// JSON configuration: what it yields, and what it refuses.
#include "scantet/app/config.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "scantet/base/error.h"

namespace scantet {
namespace {

class Config : public testing::Test {
 protected:
  std::string file_ = testing::TempDir() + std::to_string(getpid()) + "_scantet_config_" +
                      testing::UnitTest::GetInstance()->current_test_info()->name() + ".json";
  void TearDown() override { std::filesystem::remove(file_); }

  std::vector<OptionValue> read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_config(file_);
  }
  Error refused(const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(file_), std::string::npos) << "the file is not named";
      return error;
    }
    ADD_FAILURE() << "accepted " << text;
    return {Fault::internal, "", ""};
  }
};

TEST_F(Config, ValuesBecomeTexts) {
  const auto values = read(R"({"size": 2.5, "quiet": true, "inside": "below", "facet-distance": null,
                               "output": ["a.vtu", "b.stl"], "max-vertices": 1000000})");
  ASSERT_EQ(values.size(), 7u);
  const auto text_of = [&](const std::string& name) {
    std::string all;
    for (const auto& value : values) {
      if (value.name == name) all += value.text + "|";
    }
    return all;
  };
  EXPECT_EQ(text_of("size"), "2.5|");
  EXPECT_EQ(text_of("quiet"), "true|");
  EXPECT_EQ(text_of("inside"), "below|");
  EXPECT_EQ(text_of("facet-distance"), "none|");
  EXPECT_EQ(text_of("output"), "a.vtu|b.stl|");
  EXPECT_EQ(text_of("max-vertices"), "1000000|");
  EXPECT_EQ(values.front().place, file_ + ": \"facet-distance\"");
}

TEST_F(Config, NumbersKeepTheirValue) {
  const auto values = read(R"({"level": 0.1, "size": 1e-3})");
  ASSERT_EQ(values.size(), 2u);
  EXPECT_EQ(std::stod(values[0].text), 0.1);
  EXPECT_EQ(std::stod(values[1].text), 1e-3);
}

TEST_F(Config, BadFilesAreRefused) {
  for (const char* text : {"", "{", "[1]", "3", "{\"size\": }", "{\"size\": {\"mm\": 2}}", "{\"output\": [[1]]}",
                           "{\"size\": 1, \"size\": 2}", "\xff\xfe", "{\"size\": 1} x", "{\"size\": 1e400}"}) {
    const Error error = refused(text);
    EXPECT_EQ(error.fault(), Fault::usage) << text;
    EXPECT_EQ(error.code(), "usage.config") << text;
  }
  EXPECT_NE(std::string(refused("{\n\"size\" 2}").what()).find("line 2"), std::string::npos);
  EXPECT_NE(std::string(refused("{\"size\": 1, \"size\": 2}").what()).find("\"size\" appears twice"),
            std::string::npos);
  const std::string deep = "{\"size\": " + std::string(200000, '[') + std::string(200000, ']') + "}";
  EXPECT_NE(std::string(refused(deep).what()).find("nested too deeply"), std::string::npos);
}

TEST_F(Config, MissingFileIsRefused) {
  EXPECT_THROW(read_config("/nonexistent/job.json"), Error);
  EXPECT_THROW(read_config(testing::TempDir()), Error) << "a folder";
}

}  // namespace
}  // namespace scantet
