// The option machinery: every type sets, reads back, and refuses what is wrong with a message that names it.
#include "scantet/base/options.h"

#include <gtest/gtest.h>

#include <limits>

#include "scantet/base/error.h"

namespace scantet {
namespace {

enum class Side { left, right };

struct Sample {
  double size = 2.5;
  std::optional<double> bound;
  std::uint64_t count = 7;
  std::string name;
  std::vector<std::string> files;
  std::vector<double> levels;
  bool quiet = false;
  Side side = Side::left;
  OptionSet options;

  Sample() {
    options.add("size", size, Range::above(0), {"G", "MM", "a size in mm", "How large."});
    options.add("bound", bound, Range::between(-1, 1), {"G", "X", "a bound", "How far."});
    options.add("count", count, Range::at_least(1), {"G", "N", "a count", "How many."});
    options.add("name", name, {"G", "NAME", "a name", "Called."});
    options.add("file", files, {"G", "FILE", "a file", "Where."});
    options.add("level", levels, Range::at_least(0), {"G", "V", "a level", "How high."});
    options.add("quiet", quiet, {"G", "", "a flag", "Hush."});
    options.add("side", side, {{"left", Side::left}, {"right", Side::right}}, {"G", "SIDE", "a side", "Which."});
  }
  void set(const std::string& option, const std::string& text) { options.set({option, text, "--" + option}); }
  Error refused(const std::string& option, const std::string& text) {
    try {
      set(option, text);
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << option << " took " << text;
    return {Fault::internal, "", ""};
  }
};

TEST(Options, EveryTypeIsSetAndReadBack) {
  Sample s;
  s.set("size", "0.1");
  s.set("bound", "-1");
  s.set("count", "18446744073709551615");
  s.set("name", "a b");
  s.set("file", "x");
  s.set("file", "y");
  s.set("quiet", "true");
  s.set("side", "right");
  EXPECT_EQ(s.size, 0.1);
  EXPECT_EQ(s.bound, -1.0);
  EXPECT_EQ(s.count, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(s.name, "a b");
  EXPECT_EQ(s.files, (std::vector<std::string>{"x", "y"}));
  EXPECT_TRUE(s.quiet);
  EXPECT_EQ(s.side, Side::right);
  EXPECT_EQ(s.options.find("size")->read(), std::vector<std::string>{"0.1"});
  EXPECT_EQ(s.options.find("side")->read(), std::vector<std::string>{"right"});
  EXPECT_EQ(s.options.find("file")->read(), s.files);
  EXPECT_TRUE(s.options.find("side")->given);
}

TEST(Options, DefaultsAreThoseOfTheFields) {
  const Sample s;
  EXPECT_EQ(s.options.find("size")->default_values, std::vector<std::string>{"2.5"});
  EXPECT_TRUE(s.options.find("bound")->default_values.empty());
  EXPECT_EQ(s.options.find("count")->default_values, std::vector<std::string>{"7"});
  EXPECT_EQ(s.options.find("side")->default_values, std::vector<std::string>{"left"});
  EXPECT_EQ(s.options.find("side")->limits, "left or right");
  EXPECT_FALSE(s.options.find("size")->given);
}

TEST(Options, NoneClearsAnOptionalNumberOnly) {
  Sample s;
  s.bound = 0.5;
  s.set("bound", "none");
  EXPECT_FALSE(s.bound);
  EXPECT_EQ(s.refused("size", "none").code(), "usage.value");
}

TEST(Options, NoneClearsAList) {
  std::vector<std::string> places{"a=x > 0"};
  OptionSet options;
  options.add("set", places, {"G", "PLACE", "a place", "What."});
  options.set({"set", "none", "--set"});
  EXPECT_TRUE(places.empty());
  options.set({"set", "b=x > 0", "--set"});
  EXPECT_EQ(places.size(), 1U);
}

TEST(Options, NoneIsAValueOfItsOwnWhereTheDefaultIsAnother) {
  std::string how = "keep";
  std::string formula;
  OptionSet options;
  const auto any = [](const OptionValue&) {};
  options.add("how", how, Range::above(0), "keep or none", any, {"G", "HOW", "a way", "How."});
  options.add("formula", formula, Range::above(0), "a formula", any, {"G", "F", "a formula", "What."});
  options.set({"how", "none", "--how"});
  options.set({"formula", "none", "--formula"});
  EXPECT_TRUE(how.empty());
  EXPECT_EQ(options.find("how")->read(), std::vector<std::string>{"none"});
  EXPECT_TRUE(options.find("formula")->read().empty());
}

TEST(Options, WrongNumbersAreRefusedWithPlaceValueAndRange) {
  for (const char* text : {"-2", "0", "nan", "inf", "-inf", "1e999", "", "abc", "2mm", "1,5", " 2", "0x10"}) {
    Sample s;
    const Error error = s.refused("size", text);
    EXPECT_EQ(error.fault(), Fault::usage) << text;
    EXPECT_EQ(error.code(), "usage.value") << text;
    EXPECT_EQ(s.size, 2.5) << text;
  }
  Sample s;
  EXPECT_EQ(std::string(s.refused("size", "-2").what()),
            "--size: -2 is not a size in mm: it must be greater than 0; --size MM: How large.");
  EXPECT_EQ(s.refused("bound", "1.01").code(), "usage.value");
}

TEST(Options, CountsAreWholeNumbers) {
  Sample s;
  s.set("count", "2.5e5");
  EXPECT_EQ(s.count, 250000u);
  for (const char* text : {"-1", "0", "1.5", "1e300", "18446744073709551616", "nan", ""}) {
    Sample fresh;
    EXPECT_EQ(fresh.refused("count", text).code(), "usage.value") << text;
  }
}

TEST(Options, WrongWordsGetAHint) {
  Sample s;
  EXPECT_NE(std::string(s.refused("side", "rihgt").what()).find("did you mean right?"), std::string::npos);
  EXPECT_NE(std::string(s.refused("siez", "2").what()).find("did you mean size?"), std::string::npos);
  EXPECT_EQ(s.refused("siez", "2").code(), "usage.unknown_option");
  EXPECT_EQ(std::string(s.refused("zzzzzz", "2").what()).find("did you mean"), std::string::npos);
  EXPECT_EQ(s.refused("quiet", "yes").code(), "usage.value");
}

TEST(Options, RepeatedNumbersAreCheckedOneByOne) {
  Sample s;
  EXPECT_TRUE(s.options.find("level")->default_values.empty());
  s.set("level", "20.5");
  s.set("level", "1e1");
  EXPECT_EQ(s.levels, (std::vector<double>{20.5, 10}));
  EXPECT_EQ(s.options.find("level")->read(), (std::vector<std::string>{"20.5", "10"}));
  for (const char* text : {"-1", "nan", "inf", "", "high", "1,2"}) {
    EXPECT_EQ(s.refused("level", text).code(), "usage.value") << text;
  }
  EXPECT_EQ(s.levels.size(), 2U);
  s.set("level", "none");
  EXPECT_TRUE(s.levels.empty());
}

TEST(Options, OnlyListsMayBeRepeated) {
  Sample s;
  s.set("size", "1");
  const Error error = s.refused("size", "2");
  EXPECT_EQ(error.code(), "usage.repeated");
  EXPECT_NE(std::string(error.what()).find("(1, then 2)"), std::string::npos);
}

TEST(ClosestName, FindsTyposOnly) {
  const std::vector<std::string> names{"level", "size", "seed", "seeding", "facet-distance"};
  EXPECT_EQ(closest_name("levle", names), "level");
  EXPECT_EQ(closest_name("sizes", names), "size");
  EXPECT_EQ(closest_name("sed", names), "seed");
  EXPECT_EQ(closest_name("facetdistance", names), "facet-distance");
  EXPECT_EQ(closest_name("level", names), "level");
  EXPECT_EQ(closest_name("threads", names), std::nullopt);
  EXPECT_EQ(closest_name("", names), std::nullopt);
  EXPECT_EQ(closest_name("x", {}), std::nullopt);
}

TEST(NumberText, ReadsBackAsTheSameNumber) {
  EXPECT_EQ(number_text(2), "2");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(std::stod(number_text(1.0 / 3)), 1.0 / 3);
  for (const double number : {-1.0 / 3, -1e-4 / 3, -std::numeric_limits<double>::min(), -1e49 / 3}) {
    EXPECT_EQ(std::stod(number_text(number, 50)), number) << "with as many digits as may be asked for";
  }
}

}  // namespace
}  // namespace scantet
