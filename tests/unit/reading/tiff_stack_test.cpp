// TIFF stacks written with libtiff: types, strips and tiles, compression, spacing, and what is refused.
#include <tiffio.h>

#include "scan_files.h"

namespace scantet {
namespace {

using namespace test;

struct TiffLayout {
  std::uint16_t compression = COMPRESSION_NONE;
  bool tiled = false;
  std::string description;
  float resolution = 0;  // pixels a unit, 0: not written
  std::uint16_t resolution_unit = 0;
  int samples = 1;
  bool big_endian = false;
};

template <class T>
void write_page(TIFF* tiff, const Grid& grid, const T* values, const TiffLayout& layout) {
  const auto width = static_cast<std::uint32_t>(grid.size[0]);
  const auto height = static_cast<std::uint32_t>(grid.size[1]);
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8 * sizeof(T));
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, layout.samples);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT,
               std::is_floating_point_v<T> ? SAMPLEFORMAT_IEEEFP
               : std::is_signed_v<T>       ? SAMPLEFORMAT_INT
                                           : SAMPLEFORMAT_UINT);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, layout.samples == 1 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, layout.compression);
  if (!layout.description.empty()) TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, layout.description.c_str());
  if (layout.resolution > 0) {
    TIFFSetField(tiff, TIFFTAG_XRESOLUTION, double{layout.resolution});
    TIFFSetField(tiff, TIFFTAG_YRESOLUTION, 2 * double{layout.resolution});
    if (layout.resolution_unit > 0) TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, layout.resolution_unit);
  }
  if (!layout.tiled) {
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 2);
    std::vector<T> row(width * static_cast<std::size_t>(layout.samples));
    for (std::uint32_t y = 0; y < height; ++y) {
      std::copy_n(values + y * row.size(), row.size(), row.begin());
      TIFFWriteScanline(tiff, row.data(), y, 0);
    }
  } else {
    constexpr std::uint32_t kTile = 16;
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, kTile);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, kTile);
    for (std::uint32_t y0 = 0; y0 < height; y0 += kTile) {
      for (std::uint32_t x0 = 0; x0 < width; x0 += kTile) {
        std::vector<T> tile(kTile * kTile);
        for (std::uint32_t y = y0; y < std::min(y0 + kTile, height); ++y) {
          for (std::uint32_t x = x0; x < std::min(x0 + kTile, width); ++x) {
            tile[(y - y0) * kTile + x - x0] = values[y * width + x];
          }
        }
        TIFFWriteTile(tiff, tile.data(), x0, y0, 0, 0);
      }
    }
  }
  TIFFWriteDirectory(tiff);
}

template <class T>
void write_tiff(const std::string& path, const Grid& grid, const std::vector<T>& values,
                const TiffLayout& layout = {}) {
  TIFF* tiff = TIFFOpen(path.c_str(), layout.big_endian ? "wb" : "wl");
  const std::size_t area = values.size() / static_cast<std::size_t>(grid.size[2]);
  for (int k = 0; k < grid.size[2]; ++k) {
    write_page(tiff, grid, values.data() + static_cast<std::size_t>(k) * area, layout);
  }
  TIFFClose(tiff);
}

// 1 mm voxels at the origin: what a TIFF without resolution means. Larger than a tile.
Grid plain_grid() {
  Grid grid;
  grid.size = {21, 18, 4};
  grid.columns = {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  grid.origin = {};
  return grid;
}

template <class T>
class TiffPixelType : public testing::Test {};
using PixelTypes = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t,
                                  std::int64_t, std::uint64_t, float, double>;
TYPED_TEST_SUITE(TiffPixelType, PixelTypes);

TYPED_TEST(TiffPixelType, StripsTilesCompressionAndByteOrder) {
  const TempFolder folder;
  const Grid grid = plain_grid();
  const auto values = pattern<TypeParam>(grid);
  TiffLayout packed;
  packed.compression = COMPRESSION_LZW;
  TiffLayout tiled;
  tiled.tiled = true;
  TiffLayout big_endian;
  big_endian.big_endian = true;
  for (const TiffLayout& layout : {TiffLayout{}, packed, tiled, big_endian}) {
    write_tiff(folder / "a.tif", grid, values, layout);
    const Scan scan = read(folder / "a.tif");
    EXPECT_EQ(scan.format, "TIFF");
    expect_voxels(scan, values);
    expect_frame(scan, grid);
  }
  EXPECT_EQ(can_read_scan(folder / "a.tif"), 100);
}

TEST(TiffStack, ResolutionTagsGiveSpacing) {
  const TempFolder folder;
  Grid grid = plain_grid();
  TiffLayout layout;
  layout.resolution = 20;
  layout.resolution_unit = RESUNIT_CENTIMETER;
  grid.columns = {Vec{0.5, 0, 0}, Vec{0, 0.25, 0}, Vec{0, 0, 1}};
  write_tiff(folder / "cm.tif", grid, pattern<float>(grid), layout);
  expect_frame(read(folder / "cm.tif"), grid);
  layout.resolution_unit = RESUNIT_INCH;
  grid.columns = {Vec{1.27, 0, 0}, Vec{0, 0.635, 0}, Vec{0, 0, 1}};
  write_tiff(folder / "inch.tif", grid, pattern<float>(grid), layout);
  expect_frame(read(folder / "inch.tif"), grid);
}

TEST(TiffStack, ImageJGivesAllThreeSpacings) {
  const TempFolder folder;
  Grid grid = plain_grid();
  TiffLayout layout;
  layout.resolution = 2;
  layout.resolution_unit = RESUNIT_NONE;
  layout.description = "ImageJ=1.53t\nimages=4\nslices=4\nunit=micron\nspacing=3.5\nloop=false\n";
  grid.columns = {Vec{0.0005, 0, 0}, Vec{0, 0.00025, 0}, Vec{0, 0, 0.0035}};
  write_tiff(folder / "a.tif", grid, pattern<std::uint16_t>(grid), layout);
  expect_frame(read(folder / "a.tif"), grid);
}

TEST(TiffStack, RefusesHyperstacksAndPagesThatAreNotThere) {
  const TempFolder folder;
  const Grid grid = plain_grid();
  TiffLayout layout;
  layout.description = "ImageJ=1.53t\nimages=4\nchannels=2\nslices=2\n";
  write_tiff(folder / "a.tif", grid, pattern<float>(grid), layout);
  expect_refused(folder / "a.tif", "input.dimension");
  layout.description = "ImageJ=1.53t\nimages=400\nslices=400\n";
  write_tiff(folder / "b.tif", grid, pattern<float>(grid), layout);
  expect_refused(folder / "b.tif", "input.slices");
}

std::string ome(const std::string& sizes, const std::string& prefix = "") {
  return "<?xml version=\"1.0\"?><!-- <Pixels SizeC='9'/> --><" + prefix + "OME><" + prefix + "Image ID='a > b'>\n<" +
         prefix + "Pixels ID=\"Pixels:0\" " + sizes + "><" + prefix + "TiffData/></" + prefix + "Pixels></" + prefix +
         "Image></" + prefix + "OME>";
}

TEST(TiffStack, OmeGivesAllThreeSpacings) {
  const TempFolder folder;
  Grid grid = plain_grid();
  TiffLayout layout;
  layout.resolution = 20;  // 0.5 mm and 0.25 mm
  layout.resolution_unit = RESUNIT_CENTIMETER;
  const auto expect_steps = [&](const std::string& attributes, const Vec& steps) {
    grid.columns = {Vec{steps.x, 0, 0}, Vec{0, steps.y, 0}, Vec{0, 0, steps.z}};
    for (const std::string prefix : {"", "ome:"}) {
      layout.description = ome("SizeZ=\"4\" SizeC = '1' SizeT=\"1\" " + attributes, prefix);
      write_tiff(folder / "a.tif", grid, pattern<std::uint16_t>(grid), layout);
      expect_frame(read(folder / "a.tif"), grid);
    }
  };
  expect_steps("", {0.5, 0.25, 1});
  expect_steps("PhysicalSizeZ=\"2.5E3\"", {0.5, 0.25, 2.5});
  expect_steps("PhysicalSizeX='0.5' PhysicalSizeXUnit='mm' PhysicalSizeY='2' PhysicalSizeYUnit='cm' PhysicalSizeZ='3'",
               {0.5, 20, 0.003});
  expect_steps(
      "PhysicalSizeX='7' PhysicalSizeXUnit='nm' PhysicalSizeY='7' PhysicalSizeYUnit='\xc2\xb5m' "
      "PhysicalSizeZ='0.000007' PhysicalSizeZUnit='m'",
      {7e-6, 7e-3, 7e-3});
  expect_steps("PhysicalSizeZ='3' PhysicalSizeZUnit='pixel'", {0.5, 0.25, 1});
}

TEST(TiffStack, RefusesOmeOfChannelsTimesAndImagesAndWhatItCannotMean) {
  const TempFolder folder;
  const Grid grid = plain_grid();
  TiffLayout layout;
  const auto refused = [&](const std::string& description, const std::string& code) {
    layout.description = description;
    write_tiff(folder / "a.tif", grid, pattern<float>(grid), layout);
    return expect_refused(folder / "a.tif", code);
  };
  const std::string message = refused(ome("SizeZ='2' SizeC='2' SizeT='1'"), "input.dimension");
  EXPECT_NE(message.find("2 channels and 1 times"), std::string::npos) << message;
  refused(ome("SizeZ='2' SizeC='1' SizeT='2'"), "input.dimension");
  refused("<OME><BinaryOnly MetadataFile='a.companion.ome'/></OME>", "input.dimension");
  refused(ome("SizeZ='4' SizeC='1' SizeT='1'") + ome("SizeZ='4' SizeC='1' SizeT='1'"), "input.dimension");
  refused(ome("SizeZ='3' SizeC='1' SizeT='1'"), "input.slices");
  for (const std::string channels : {"", "SizeC=''", "SizeC='0'", "SizeC='-1'", "SizeC='1.5'", "SizeC='99999999999'",
                                     "SizeC=1", "SizeC='1", "SizeC", "XSizeC='1'"}) {
    refused(ome("SizeZ='4' SizeT='1' " + channels), "input.slices");
  }
  for (const std::string step : {"'0'", "'-1'", "'nan'", "'inf'", "'1e999'", "'1 mm'", "''", "'1\n2'", "'1e-320'",
                                 "'1' PhysicalSizeZUnit='furlong'"}) {
    refused(ome("SizeZ='4' SizeC='1' SizeT='1' PhysicalSizeZ=" + step), "input.frame");
  }
  const std::string whole = ome("SizeZ='4' SizeC='1' SizeT='1' PhysicalSizeZ='1'");
  for (std::size_t kept = whole.find("OME>") + 4; kept < whole.find("PhysicalSizeZ") - 1; ++kept) {
    layout.description = whole.substr(0, kept);
    write_tiff(folder / "cut.tif", grid, pattern<float>(grid), layout);
    EXPECT_THROW(read(folder / "cut.tif"), Error) << layout.description;
  }
}

TEST(TiffStack, RefusesOnePageColourAndUnequalPages) {
  const TempFolder folder;
  Grid grid = plain_grid();
  Grid one = grid;
  one.size[2] = 1;
  write_tiff(folder / "one.tif", one, pattern<float>(one));
  expect_refused(folder / "one.tif", "input.dimension");

  TiffLayout colour;
  colour.samples = 3;
  std::vector<std::uint8_t> values(3 * grid.count(), 7);
  write_tiff(folder / "rgb.tif", grid, values, colour);
  const std::string message = expect_refused(folder / "rgb.tif", "input.pixel_type");
  EXPECT_NE(message.find("3 values"), std::string::npos) << message;
  colour.description = ome("SizeZ='4' SizeC='3' SizeT='1'");
  write_tiff(folder / "rgb.tif", grid, values, colour);
  expect_refused(folder / "rgb.tif", "input.pixel_type");

  TIFF* tiff = TIFFOpen((folder / "mixed.tif").c_str(), "w");
  const auto pages = pattern<float>(grid);
  write_page(tiff, grid, pages.data(), {});
  write_page(tiff, grid, pages.data(), {});
  --grid.size[0];
  write_page(tiff, grid, pages.data(), {});
  TIFFClose(tiff);
  EXPECT_NE(expect_refused(folder / "mixed.tif", "input.slices").find("page 3"), std::string::npos);
}

TEST(TiffStack, RefusesATruncatedFileQuietly) {
  const TempFolder folder;
  const Grid grid = plain_grid();
  TiffLayout packed;
  packed.compression = COMPRESSION_LZW;
  for (const TiffLayout& layout : {TiffLayout{}, packed}) {
    write_tiff(folder / "a.tif", grid, pattern<float>(grid), layout);
    const std::string whole = bytes_of(folder / "a.tif");
    testing::internal::CaptureStderr();
    for (std::size_t kept = 8; kept < whole.size(); kept += 97) {
      write_text(folder / "cut.tif", whole.substr(0, kept));
      expect_refused(folder / "cut.tif", "input.corrupt");
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
}

}  // namespace
}  // namespace scantet
