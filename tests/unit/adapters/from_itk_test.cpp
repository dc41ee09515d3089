#include "scantet/adapters/from_itk.h"

#include <gtest/gtest.h>
#include <itkRGBPixel.h>

#include <cstdint>
#include <string>

#include "error_code.h"
#include "scantet/image/level_set.h"

namespace scantet {
namespace {

template <class Pixel>
using Image = itk::Image<Pixel, 3>;

/// Values i + 10 j + 100 k; the first index of the region is not 0, the axes are turned and of different steps.
template <class Pixel>
typename Image<Pixel>::Pointer make_image() {
  auto image = Image<Pixel>::New();
  const typename Image<Pixel>::RegionType region({5, -2, 1}, {4, 3, 2});
  image->SetRegions(region);
  image->Allocate();
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 4; ++i) image->SetPixel({i + 5, j - 2, k + 1}, static_cast<Pixel>(i + 10 * j + 100 * k));
    }
  }
  const double origin[] = {-7, 8, 9};
  const double spacing[] = {0.5, 2, 3};
  typename Image<Pixel>::DirectionType direction;  // about z by 30 degrees, then mirrored
  direction.Fill(0);
  direction[0][0] = std::sqrt(0.75);
  direction[1][0] = 0.5;
  direction[0][1] = -0.5;
  direction[1][1] = std::sqrt(0.75);
  direction[2][2] = -1;
  image->SetOrigin(origin);
  image->SetSpacing(spacing);
  image->SetDirection(direction);
  return image;
}

TEST(FromItk, PutsEveryVoxelWhereItkHasIt) {
  const auto image = make_image<short>();
  const Scan scan = scan_from_itk(image.GetPointer());
  EXPECT_EQ(scan.size, (std::array<int, 3>{4, 3, 2}));
  EXPECT_EQ(scan.pixel_type, "int16");
  EXPECT_EQ(scan.format, "ITK image");
  EXPECT_EQ(scan.min_value, 0);
  EXPECT_EQ(scan.max_value, 123);
  const auto* voxels = std::get<const std::int16_t*>(scan.voxels);
  EXPECT_EQ(voxels, image->GetBufferPointer());
  for (const Image<short>::IndexType& index : {Image<short>::IndexType{5, -2, 1}, {8, -2, 1}, {5, 0, 1}, {8, 0, 2}}) {
    const Vec from_first{double(index[0] - 5), double(index[1] + 2), double(index[2] - 1)};
    const auto world = image->TransformIndexToPhysicalPoint<double>(index);
    EXPECT_LT(distance(scan.frame.to_world(from_first), {world[0], world[1], world[2]}), 1e-12);
    const auto at = static_cast<std::size_t>(from_first.x + 4 * (from_first.y + 3 * from_first.z));
    EXPECT_EQ(voxels[at], image->GetPixel(index));
  }
  EXPECT_LT(scan.frame.determinant_mm3(), 0);
}

TEST(FromItk, TakesEveryPixelThatIsANumber) {
  const auto type_of = [](auto pixel) { return scan_from_itk(make_image<decltype(pixel)>().GetPointer()).pixel_type; };
  EXPECT_EQ(type_of(char{}), std::is_signed_v<char> ? "int8" : "uint8");
  EXPECT_EQ(type_of(static_cast<unsigned char>(0)), "uint8");
  EXPECT_EQ(type_of(static_cast<unsigned short>(0)), "uint16");
  EXPECT_EQ(type_of(0), "int32");
  EXPECT_EQ(type_of(0U), "uint32");
  EXPECT_EQ(type_of(0L), "int64");
  EXPECT_EQ(type_of(0LL), "int64");
  EXPECT_EQ(type_of(0ULL), "uint64");
  EXPECT_EQ(type_of(0.F), "float");
  EXPECT_EQ(type_of(0.0), "double");
}

template <class Pixel>
concept Adapts = requires(const itk::Image<Pixel, 3>* image) {
  scan_from_itk(image);
};

TEST(FromItk, IsNotForPixelsOfSeveralValues) {
  static_assert(Adapts<short>);
  static_assert(!Adapts<itk::RGBPixel<unsigned char>>);
  static_assert(!Adapts<itk::Vector<float, 3>>);
  static_assert(!Adapts<bool>);
}

TEST(FromItk, KeepsTheVoxelsAfterTheImageIsGone) {
  std::unique_ptr<Domain> domain;
  {
    const auto image = make_image<float>();
    domain = make_level_set(scan_from_itk(image.GetPointer()), {.level = 50});
  }
  const Frame frame = scan_from_itk(make_image<float>().GetPointer()).frame;
  EXPECT_EQ(domain->region_at(frame.to_world({2, 1, 1})), 1);
  EXPECT_EQ(domain->region_at(frame.to_world({2, 1, 0})), kOutside);
}

TEST(FromItk, RefusesNoImageAndAPartOfOne) {
  EXPECT_EQ(test::error_code([] { scan_from_itk(static_cast<const Image<short>*>(nullptr)); }), "input.format");
  const auto image = make_image<short>();
  image->SetLargestPossibleRegion({{5, -2, 1}, {4, 3, 9}});
  EXPECT_EQ(test::error_code([&] { scan_from_itk(image.GetPointer()); }), "input.dimension");
  EXPECT_EQ(test::error_code([] { scan_from_itk(Image<short>::New().GetPointer()); }),
            "input.pixel_type");  // never allocated
}

}  // namespace
}  // namespace scantet
