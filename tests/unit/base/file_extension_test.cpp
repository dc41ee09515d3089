#include "scantet/base/file_extension.h"

#include <gtest/gtest.h>

#include <clocale>

namespace scantet {
namespace {

TEST(FileExtension, IsLowerCaseWithItsDot) {
  EXPECT_EQ(file_extension("a/Head.NRRD"), ".nrrd");
  EXPECT_EQ(file_extension("a.b/head.nii.gz"), ".gz");
  EXPECT_EQ(file_extension("a.b/head"), "");
  EXPECT_EQ(file_extension("a/.nrrd"), "");
  EXPECT_EQ(file_extension(""), "");
}

TEST(FileExtension, BytesBeyondAsciiStay) {
  const std::string before = std::setlocale(LC_CTYPE, nullptr);
  for (const char* locale : {"C", "de_DE.ISO-8859-1", "en_US.ISO-8859-1"}) {  // where these are installed
    std::setlocale(LC_CTYPE, locale);
    EXPECT_EQ(file_extension("a.\xC4Z"), ".\xC4z") << locale;
  }
  std::setlocale(LC_CTYPE, before.c_str());
}

}  // namespace
}  // namespace scantet
