#include "scantet/io/sha256.h"

#include "unit/io/io_test_support.h"

namespace scantet {
namespace {

class Sha256 : public IoTest {};

// The examples of FIPS 180-4.
TEST_F(Sha256, KnownDigests) {
  EXPECT_EQ(sha256_text(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_text("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_text(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_F(Sha256, FilesOfAnySize) {
  for (const std::size_t size : {0, 1, 262143, 262144, 262145, 1000000}) {
    const std::string content(size, 'a');
    put_content(file("a"), content);
    EXPECT_EQ(sha256_file(file("a")), sha256_text(content)) << size;
  }
  put_content(file("zero"), std::string("a\0b\n\r", 5));
  EXPECT_EQ(sha256_file(file("zero")), sha256_text(std::string_view("a\0b\n\r", 5)));
}

TEST_F(Sha256, FilesThatCannotBeRead) {
  for (const std::string& path : {file("none"), folder_.string()}) {
    try {
      sha256_file(path);
      ADD_FAILURE() << path;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), "input.cannot_open");
      EXPECT_EQ(e.fault(), Fault::input);
      EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace scantet
