// Pages of a TIFF file as slices, through libtiff itself. ITK 5.2's reader gets too much wrong to stand behind: 32-bit
// integers are read as bytes, 64-bit samples as 16-bit, tiles and pages of another size overrun its buffer, and its
// built-in libtiff prints to stderr. libtiff takes care of byte order and compression; strips and tiles differ only in
// how a page is cut up.
// Spacing: resolution tags give x and y; ImageJ's description gives z ("spacing=") and the unit. In an OME-TIFF the
// description is XML, of which the attributes of the element Pixels count: sizes and the steps along all three axes.
// Source: OME Data Model, schema of June 2016 (Pixels, UnitsLength).
#include <tiffio.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>
#include <string_view>

#include "scantet/reading/image_source_impl.h"

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
  switch (page.bits) {
    case 8:
      return real ? std::nullopt : std::optional(is_signed ? VoxelType::int8 : VoxelType::uint8);
    case 16:
      return real ? std::nullopt : std::optional(is_signed ? VoxelType::int16 : VoxelType::uint16);
    case 32:
      return real ? VoxelType::float32 : is_signed ? VoxelType::int32 : VoxelType::uint32;
    case 64:
      return real ? VoxelType::float64 : is_signed ? VoxelType::int64 : VoxelType::uint64;
    default:
      return std::nullopt;
  }
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

constexpr std::string_view kBlanks = " \t\r\n";

// Behind the markup that begins at `at`. Of a tag that ends at its '>', where quotes hold none.
std::size_t end_of_markup(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  const auto behind = [&](std::string_view mark) {
    const std::size_t found = text.find(mark, at);
    return found == std::string_view::npos ? text.size() : found + mark.size();
  };
  if (rest.starts_with("<!--")) return behind("-->");
  if (rest.starts_with("<![CDATA[")) return behind("]]>");
  if (rest.starts_with("<?")) return behind("?>");
  char quote = 0;
  for (; at < text.size(); ++at) {
    if (quote == 0 && text[at] == '>') return at + 1;
    if (quote == 0 && (text[at] == '"' || text[at] == '\'')) {
      quote = text[at];
    } else if (text[at] == quote) {
      quote = 0;
    }
  }
  return text.size();
}

// Of the elements called so, with whatever prefix: what their opening tags have behind the name.
std::vector<std::string_view> tags_of(std::string_view text, std::string_view name) {
  std::vector<std::string_view> tags;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
    const std::size_t end = end_of_markup(text, at);
    const std::string_view tag = text.substr(at + 1, end - at - 1);
    const std::string_view full_name = tag.substr(0, tag.find_first_of(" \t\r\n/>"));
    if (full_name.substr(full_name.rfind(':') + 1) == name) tags.push_back(tag.substr(full_name.size()));
    at = end;
  }
  return tags;
}

// The value of an attribute of a tag; nullopt if it has none that can be read.
std::optional<std::string_view> attribute_of(std::string_view tag, std::string_view name) {
  const auto skip_blanks = [&] { tag.remove_prefix(std::min(tag.find_first_not_of(kBlanks), tag.size())); };
  for (skip_blanks(); !tag.empty(); skip_blanks()) {
    const std::string_view key = tag.substr(0, tag.find_first_of(" \t\r\n="));
    tag.remove_prefix(key.size());
    skip_blanks();
    if (!tag.starts_with('=')) return std::nullopt;
    tag.remove_prefix(1);
    skip_blanks();
    if (!tag.starts_with('"') && !tag.starts_with('\'')) return std::nullopt;
    const std::size_t end = tag.find(tag[0], 1);
    if (end == std::string_view::npos) return std::nullopt;
    if (key == name) return tag.substr(1, end - 1);
    tag.remove_prefix(end + 1);
  }
  return std::nullopt;
}

// The number that all of the text is; nullopt if it is none.
template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, number);
  return code == std::errc{} && stop == end ? std::optional(number) : std::nullopt;
}

// Of a text that a file holds: so much as a line of a message has room for.
std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string line(text.substr(0, kLongest));
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return "'" + line + "'";
}

// Of a unit of OME; nullopt if it is none of those that are known here.
std::optional<double> ome_unit_mm(std::string_view unit) {
  constexpr double kMicrometre = 1e-3;
  constexpr std::pair<std::string_view, double> kUnits[] = {{"nm", 1e-6}, {"mm", 1}, {"cm", 10}, {"m", 1000}};
  // The sign of micro in UTF-8 and Latin-1, the Greek letter in UTF-8, and both as XML may escape them.
  for (const std::string_view micro :
       {"\xc2\xb5", "\xb5", "\xce\xbc", "&#181;", "&#xB5;", "&#xb5;", "&#956;", "&#x3BC;", "&#x3bc;", "u"}) {
    if (unit.starts_with(micro) && unit.substr(micro.size()) == "m") return kMicrometre;
  }
  for (const auto& [name, mm] : kUnits) {
    if (unit == name) return mm;
  }
  return std::nullopt;
}

// The step along X, Y or Z that the element Pixels of OME names, in mm; `otherwise` if it names none.
double ome_step_mm(std::string_view pixels, const std::string& axis, double otherwise, const std::string& path) {
  const std::string key = "PhysicalSize" + axis;
  const auto text = attribute_of(pixels, key);
  const std::string_view unit = attribute_of(pixels, key + "Unit").value_or("um");
  if (!text || unit == "pixel" || unit == "reference frame") return otherwise;  // these two have no length
  const auto unit_mm = ome_unit_mm(unit);
  const double step_mm = number_in<double>(*text).value_or(0) * unit_mm.value_or(0);
  if (step_mm > 0 && std::isfinite(step_mm)) return step_mm;
  throw Error(Fault::input, "input.frame",
              "'" + path + "' has the " + key + " " + quoted(*text) + " in " + quoted(unit) + ", which is no length",
              "correct it; units may be \xc2\xb5m, nm, mm, cm and m");
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
    if (!tags_of(description, "OME").empty() && first_.samples == 1) {  // colours are refused as such
      const std::string_view pixels = pixels_of_ome(description);
      spacing = {ome_step_mm(pixels, "X", spacing.x, path_), ome_step_mm(pixels, "Y", spacing.y, path_),
                 ome_step_mm(pixels, "Z", spacing.z, path_)};
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

  // Its element Pixels, if the pages are the slices of one volume. Channels and times are pages in OME-TIFF, too; a
  // file may have pages of several images, or be one of several files of an image.
  std::string_view pixels_of_ome(std::string_view description) const {
    const std::vector<std::string_view> images = tags_of(description, "Pixels");
    if (images.size() != 1) {
      throw Error(Fault::input, "input.dimension",
                  "'" + path_ + "' is an OME-TIFF whose header describes " + std::to_string(images.size()) + " images",
                  "save one image as a stack of its own, which holds its description");
    }
    const auto size = [&](const std::string& key) {
      const std::string_view text = attribute_of(images.front(), key).value_or("");
      const std::int32_t count = number_in<std::int32_t>(text).value_or(0);
      if (count >= 1) return count;
      throw Error(Fault::input, "input.slices",
                  "'" + path_ + "' is an OME-TIFF whose " + key + " is " + quoted(text) + ", no whole number from 1 on",
                  "correct its description, or save it as NRRD");
    };
    check_pages("OME", size("SizeC"), size("SizeT"), size("SizeZ"));
    return images.front();
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
