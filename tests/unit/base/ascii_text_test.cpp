#include "scantet/base/ascii_text.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

TEST(AsciiText, OtherBytesStay) {
  EXPECT_EQ(ascii_lower("Space Directions:"), "space directions:");
  EXPECT_EQ(ascii_upper("nset=Top_1"), "NSET=TOP_1");
  const std::string latin = "\xC4z\xE4";  // Ä and ä of ISO 8859-1, which its locales call letters
  EXPECT_EQ(ascii_lower(latin), latin);
  EXPECT_EQ(ascii_upper(latin), "\xC4Z\xE4");
}

TEST(AsciiText, BlanksGoAtBothEnds) {
  EXPECT_EQ(trimmed(" \t a b\r"), "a b");
  EXPECT_EQ(trimmed(" \t\r"), "");
  EXPECT_EQ(trimmed(""), "");
  EXPECT_EQ(trimmed("a"), "a");
}

}  // namespace
}  // namespace scantet
