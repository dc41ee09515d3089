// The two forms of the facts about an input.
#include "scantet/app/info.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace scantet {
namespace {

std::vector<InfoSection> facts() {
  return {{"b",
           "Second by name, first in order",
           {{"third", "a third", 1.0 / 3, "mm"}, {"count", "count", std::int64_t{7}, ""}}},
          {"a",
           "Other",
           {{"flag", "flag", true, ""},
            {"name", "name", std::string("\xff odd bytes"), ""},
            {"list_mm", "list", std::vector<double>{1, 2.5}, "mm"},
            {"none", "empty list", std::vector<double>{}, ""}}}};
}

TEST(Info, JsonKeepsOrderKeysAndExactNumbers) {
  const auto json = nlohmann::ordered_json::parse(info_json(facts()));
  EXPECT_EQ(json.begin().key(), "b");
  EXPECT_EQ(json["b"]["third"].get<double>(), 1.0 / 3);
  EXPECT_EQ(json["b"]["count"], 7);
  EXPECT_EQ(json["a"]["flag"], true);
  EXPECT_EQ(json["a"]["list_mm"], (std::vector<double>{1, 2.5}));
  EXPECT_TRUE(json["a"]["none"].empty());
}

TEST(Info, TextIsAlignedWithUnits) {
  const std::string text = info_text(facts());
  EXPECT_NE(text.find("  a third     0.333333 mm\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  flag        yes\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  list        1  2.5 mm\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  empty list  none\n"), std::string::npos) << text;
  EXPECT_LT(text.find("Second by name"), text.find("Other"));
}

TEST(Info, TextHasWholeLabelsAndOneLineEach) {
  const std::string text = info_text({{"a",
                                       "A",
                                       {{"touches", "touches", std::vector<double>{0, 614454277, -3}, ""},
                                        {"name", "name", std::string("grid\n  level  7"), ""}}}});
  EXPECT_NE(text.find("touches  0  614454277  -3\n"), std::string::npos) << text;
  EXPECT_NE(text.find("name     grid   level  7\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace scantet
