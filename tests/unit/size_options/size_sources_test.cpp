#include "scantet/size_options/size_sources.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scantet/base/error.h"

namespace scantet {
namespace {

const Box kObject{{-10, -10, -10}, {10, 10, 10}};

/// 4 x 4 x 4 voxels of 10 mm, all 2.5, the first of them centred at `origin` on each axis; gone afterwards.
class ImageOfSizes {
 public:
  explicit ImageOfSizes(double origin) {
    std::string name = (std::filesystem::temp_directory_path() / "scantet_sizes_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
    const std::string at = std::to_string(origin);
    std::ofstream out(path(), std::ios::binary);
    out << "NRRD0004\ntype: float\ndimension: 3\nsizes: 4 4 4\nencoding: text\n"
        << "space: left-posterior-superior\nspace directions: (10,0,0) (0,10,0) (0,0,10)\nspace origin: (" << at << ','
        << at << ',' << at << ")\n\n";
    for (int n = 0; n < 64; ++n) out << "2.5\n";
  }
  ~ImageOfSizes() { std::filesystem::remove_all(folder_); }
  ImageOfSizes(const ImageOfSizes&) = delete;
  ImageOfSizes& operator=(const ImageOfSizes&) = delete;
  std::string path() const { return (folder_ / "sizes.nrrd").string(); }

 private:
  std::filesystem::path folder_;
};

double size_at_origin(const SizeSource& source) {
  const SizePlace place{{}, 0, 1};
  double size = 0;
  source.sizes_at({&place, 1}, {&size, 1});
  return size;
}

TEST(SizeSources, ANumberAndAFormulaNeedNoFile) {
  Progress progress;
  std::vector<std::string> files;
  EXPECT_EQ(size_at_origin(*read_source(read_size("--size", "1.5"), kObject, progress, files)), 1.5);
  EXPECT_EQ(size_at_origin(*read_source(read_size("--size", "2 + x"), kObject, progress, files)), 2);
  EXPECT_TRUE(files.empty());
}

TEST(SizeSources, AnImageIsReadAndItsFileNamed) {
  const ImageOfSizes image(-15);
  Progress progress;
  std::vector<std::string> files;
  EXPECT_EQ(size_at_origin(*read_source(read_size("--size", image.path()), kObject, progress, files)), 2.5);
  EXPECT_EQ(files, (std::vector<std::string>{image.path()}));
}

TEST(SizeSources, AnImageElsewhereIsRefused) {
  const ImageOfSizes image(100);
  Progress progress;
  std::vector<std::string> files;
  try {
    read_source(read_size("--size", image.path()), kObject, progress, files);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "input.size_image");
    EXPECT_NE(std::string(error.what())
                  .find(": the image of sizes is elsewhere than the object: along axis x it covers "
                        "95 to 135 mm, the object -10 to 10 mm"),
              std::string::npos)
        << error.what();
  }
}

TEST(SizeSources, AnImageMayCoverAPartOfTheObject) {
  EXPECT_NO_THROW(check_covers({{9, -50, -50}, {50, 50, 50}}, kObject, "sizes"));
  EXPECT_THROW(check_covers({{-50, -50, 11}, {50, 50, 50}}, kObject, "sizes"), Error);
}

}  // namespace
}  // namespace scantet
