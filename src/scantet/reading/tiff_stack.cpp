// Pages of a TIFF file as slices, through libtiff itself. ITK 5.2's reader gets too much wrong to stand behind: 32-bit
// integers are read as bytes, 64-bit samples as 16-bit, tiles and pages of another size overrun its buffer, and its
// built-in libtiff prints to stderr. libtiff takes care of byte order and compression; strips and tiles differ only in
// how a page is cut up.
// Spacing: resolution tags give x and y; ImageJ's description gives z ("spacing=") and the unit, that of an OME-TIFF
// all three (ome_pixels.cpp).
#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "scantet/reading/image_source_impl.h"
#include "scantet/reading/ome_pixels_impl.h"

namespace scantet {
namespace {

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffPointer = std::unique_ptr<TIFF, CloseTiff>;

int keep_message(TIFF*, void* last, const char*, const char* format, va_list arguments) {
  std::array<char, 256> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  *static_cast<std::string*>(last) = text.data();
  return 1;
}

int drop_message(TIFF*, void*, const char*, const char*, va_list) {
  return 1;
}

TiffPointer open_quietly(const std::string& path, std::string& last_error) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, keep_message, &last_error);
  TIFFOpenOptionsSetWarningHandlerExtR(options, drop_message, nullptr);
  TiffPointer tiff(TIFFOpenExt(path.c_str(), "rm", options));  // m: no memory map, so a truncated file is an error
  TIFFOpenOptionsFree(options);
  return tiff;
}

struct Page {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint16_t bits = 1;
  std::uint16_t samples = 1;
  std::uint16_t sample_format = SAMPLEFORMAT_UINT;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  friend bool operator==(const Page&, const Page&) = default;
};

Page current_page(TIFF* tiff) {
  Page page;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &page.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &page.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &page.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &page.samples);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &page.sample_format);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &page.photometric);
  return page;
}

// Thumbnails and masks are not slices.
bool is_slice(TIFF* tiff) {
  std::uint32_t kind = 0;
  TIFFGetField(tiff, TIFFTAG_SUBFILETYPE, &kind);
  return (kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) == 0;
}

std::optional<VoxelType> type_of(const Page& page) {
  const bool real = page.sample_format == SAMPLEFORMAT_IEEEFP;
  const bool is_signed = page.sample_format == SAMPLEFORMAT_INT;
  const bool is_unsigned = page.sample_format == SAMPLEFORMAT_UINT || page.sample_format == SAMPLEFORMAT_VOID;
  if (!real && !is_signed && !is_unsigned) return std::nullopt;
  if (page.bits % 8 != 0) return std::nullopt;
  return voxel_type(page.bits / 8, real, is_signed);
}

// "key=value" in ImageJ's description; empty if it is not there.
std::string imagej_value(const std::string& description, const std::string& key) {
  std::istringstream lines(description);
  std::string line;
  while (std::getline(lines, line)) {
    if (line.rfind(key + "=", 0) == 0) return line.substr(key.size() + 1);
  }
  return {};
}

double imagej_number(const std::string& description, const std::string& key, double otherwise) {
  std::istringstream stream(imagej_value(description, key));
  stream.imbue(std::locale::classic());
  double value = 0;
  return stream >> value ? value : otherwise;
}

double unit_mm(const std::string& unit, std::uint16_t resolution_unit) {
  if (unit == "cm") return 10;
  if (unit == "inch") return 25.4;
  if (unit == "nm") return 1e-6;
  if (unit == "um" || unit == "micron" || unit == "\xc2\xb5m" || unit == "\\u00B5m") return 1e-3;
  if (!unit.empty() || resolution_unit == RESUNIT_NONE) return 1;
  return resolution_unit == RESUNIT_CENTIMETER ? 10 : 25.4;
}

Vec spacing_of(TIFF* tiff, const std::string& description) {
  std::uint16_t resolution_unit = RESUNIT_NONE;  // a file with resolutions but no unit: ImageJ's, or meaningless
  const bool has_unit = TIFFGetField(tiff, TIFFTAG_RESOLUTIONUNIT, &resolution_unit) != 0;
  const double unit = unit_mm(imagej_value(description, "unit"), resolution_unit);
  const bool imagej = !imagej_value(description, "ImageJ").empty();
  Vec spacing{1, 1, imagej ? unit * imagej_number(description, "spacing", 1 / unit) : 1};
  float x = 0;
  float y = 0;
  TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &x);
  TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &y);
  const bool meaningful = (has_unit && resolution_unit != RESUNIT_NONE) || imagej;
  if (meaningful && x > 0 && y > 0) {
    spacing.x = unit / double{x};
    spacing.y = unit / double{y};
  }
  spacing.z = std::abs(spacing.z);
  return spacing;
}

class TiffStack final : public ImageSource {
 public:
  explicit TiffStack(const std::string& path) : path_(path), tiff_(open_quietly(path, last_error_)) {
    if (!tiff_) throw corrupt_file(path_, last_error_);
    first_ = current_page(tiff_.get());
    std::string description;
    const char* text = nullptr;
    if (TIFFGetField(tiff_.get(), TIFFTAG_IMAGEDESCRIPTION, &text) != 0 && text != nullptr) description = text;
    Vec spacing = spacing_of(tiff_.get(), description);
    collect_pages();
    check_description(description);
    const auto ome =
        first_.samples == 1 ? ome_pixels(description, path_) : std::nullopt;  // colours are refused as such
    if (ome) {
      check_pages("OME", ome->channels, ome->times, ome->slices);
      for (int axis = 0; axis < 3; ++axis) {
        spacing[axis] = ome->step_mm[static_cast<std::size_t>(axis)].value_or(spacing[axis]);
      }
    }
    header_.format = "TIFF";
    header_.size = {first_.width, first_.height, static_cast<std::int64_t>(pages_.size())};
    header_.columns = {Vec{spacing.x, 0, 0}, Vec{0, spacing.y, 0}, Vec{0, 0, spacing.z}};
    header_.type = type_of(first_);
    header_.type_name = std::to_string(first_.bits) + "-bit";
    header_.components = first_.photometric == PHOTOMETRIC_PALETTE ? 3 : first_.samples;
    header_.pixel_kind = header_.components == 1 ? "scalar" : "rgb";
  }

  const ImageHeader& header() const override { return header_; }

  bool read(void* voxels, Progress& progress) override {
    const std::int64_t row_bytes = header_.size[0] * voxel_bytes(*header_.type);
    auto* place = static_cast<unsigned char*>(voxels);
    for (std::size_t k = 0; k < pages_.size(); ++k, place += row_bytes * header_.size[1]) {
      if (progress.cancelled()) return false;
      progress.report({"read", "slices", k, pages_.size(), 0});
      if (TIFFSetDirectory(tiff_.get(), pages_[k]) == 0) fail(k);
      TIFFIsTiled(tiff_.get()) != 0 ? read_tiles(k, place, row_bytes) : read_rows(k, place, row_bytes);
    }
    return true;
  }

 private:
  void collect_pages() {
    int number = 0;
    do {
      if (!is_slice(tiff_.get())) continue;
      const Page page = current_page(tiff_.get());
      if (pages_.empty()) first_ = page;
      if (page != first_) {
        throw Error(Fault::input, "input.slices",
                    "page " + std::to_string(number + 1) + " of '" + path_ + "' differs from the first in size or type",
                    "save the slices of one stack as pages of one size");
      }
      pages_.push_back(static_cast<tdir_t>(number));
    } while (++number, TIFFReadDirectory(tiff_.get()) != 0);
    if (!last_error_.empty() || pages_.empty()) throw corrupt_file(path_, last_error_);
  }

  // ImageJ's hyperstacks interleave channels and times as pages; its files above 4 GB describe one page of many.
  void check_description(const std::string& description) const {
    if (imagej_value(description, "ImageJ").empty()) return;
    check_pages("ImageJ", imagej_number(description, "channels", 1), imagej_number(description, "frames", 1),
                imagej_number(description, "images", static_cast<double>(pages_.size())));
  }

  // That the pages are the slices of one volume, as their description says.
  void check_pages(const char* kind, double channels, double times, double slices) const {
    std::ostringstream message;
    message << "'" << path_ << "' is an " << kind << " stack of ";
    if (channels > 1 || times > 1) {
      message << channels << " channels and " << times << " times";
      throw Error(Fault::input, "input.dimension", message.str(), "save one channel and time as a stack of its own");
    }
    if (slices != static_cast<double>(pages_.size())) {
      message << slices << " slices, with " << pages_.size() << " TIFF pages";
      throw Error(Fault::input, "input.slices", message.str(), "save it as NRRD");
    }
  }

  void read_rows(std::size_t k, unsigned char* place, std::int64_t row_bytes) {
    if (TIFFScanlineSize64(tiff_.get()) != static_cast<std::uint64_t>(row_bytes)) fail(k);
    for (std::uint32_t row = 0; row < first_.height; ++row, place += row_bytes) {
      if (TIFFReadScanline(tiff_.get(), place, row, 0) != 1) fail(k);
    }
  }

  void read_tiles(std::size_t k, unsigned char* place, std::int64_t row_bytes) {
    std::uint32_t tile_width = 0;
    std::uint32_t tile_height = 0;
    TIFFGetField(tiff_.get(), TIFFTAG_TILEWIDTH, &tile_width);
    TIFFGetField(tiff_.get(), TIFFTAG_TILELENGTH, &tile_height);
    const std::int64_t bytes = voxel_bytes(*header_.type);
    const std::uint64_t tile_bytes = TIFFTileSize64(tiff_.get());
    const bool sane = tile_width > 0 && tile_height > 0 &&
                      tile_bytes == std::uint64_t{tile_width} * tile_height * static_cast<std::uint64_t>(bytes);
    constexpr std::uint64_t kLargestTile = 1U << 30;
    if (!sane || tile_bytes > kLargestTile) fail(k);
    std::vector<unsigned char> tile(tile_bytes);
    for (std::uint32_t y = 0; y < first_.height; y += tile_height) {
      for (std::uint32_t x = 0; x < first_.width; x += tile_width) {
        if (TIFFReadTile(tiff_.get(), tile.data(), x, y, 0, 0) < 0) fail(k);
        const std::uint32_t rows = std::min(tile_height, first_.height - y);
        const std::uint32_t columns = std::min(tile_width, first_.width - x);
        for (std::uint32_t row = 0; row < rows; ++row) {
          std::memcpy(place + (y + row) * row_bytes + x * bytes, tile.data() + std::int64_t{row} * tile_width * bytes,
                      static_cast<std::size_t>(columns * bytes));
        }
      }
    }
  }

  [[noreturn]] void fail(std::size_t k) const {
    throw corrupt_file(path_, "page " + std::to_string(pages_[k] + 1) + ": " +
                                  (last_error_.empty() ? "unexpected layout" : last_error_));
  }

  std::string path_;
  std::string last_error_;
  TiffPointer tiff_;
  Page first_;
  std::vector<tdir_t> pages_;
  ImageHeader header_;
};

}  // namespace

bool is_tiff_file(const std::string& path) {
  const std::string start = first_bytes(path, 4);
  return start == std::string("II*\0", 4) || start == std::string("MM\0*", 4) || start == std::string("II+\0", 4) ||
         start == std::string("MM\0+", 4);
}

std::unique_ptr<ImageSource> open_tiff_stack(const std::string& path) {
  return std::make_unique<TiffStack>(path);
}

}  // namespace scantet
