#include "scantet/base/file_extension.h"

#include <gtest/gtest.h>

namespace scantet {
namespace {

TEST(FileExtension, IsLowerCaseWithItsDot) {
  EXPECT_EQ(file_extension("a/Head.NRRD"), ".nrrd");
  EXPECT_EQ(file_extension("a.b/head.nii.gz"), ".gz");
  EXPECT_EQ(file_extension("a.b/head"), "");
  EXPECT_EQ(file_extension("a/.nrrd"), "");
  EXPECT_EQ(file_extension(""), "");
}

}  // namespace
}  // namespace scantet
