// The description is XML, of which the attributes of the element Pixels count: sizes and the steps along all three
// axes. Channels and times are pages in OME-TIFF, too; a file may have pages of several images, or be one of several
// files of an image. Source: OME Data Model, schema of June 2016 (Pixels, UnitsLength).
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/reading/ome_pixels_impl.h"

namespace scantet {
namespace {

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

class Description {
 public:
  Description(std::string_view pixels, const std::string& path) : pixels_(pixels), path_(path) {}

  std::int32_t size(const std::string& key) const {
    const std::string_view text = attribute_of(pixels_, key).value_or("");
    const std::int32_t count = number_in<std::int32_t>(text).value_or(0);
    if (count >= 1) return count;
    throw Error(Fault::input, "input.slices",
                "'" + path_ + "' is an OME-TIFF whose " + key + " is " + quoted(text) + ", no whole number from 1 on",
                "correct its description, or save it as NRRD");
  }

  // Along X, Y or Z.
  std::optional<double> step_mm(const std::string& axis) const {
    const std::string key = "PhysicalSize" + axis;
    const auto text = attribute_of(pixels_, key);
    const std::string_view unit = attribute_of(pixels_, key + "Unit").value_or("um");
    if (!text || unit == "pixel" || unit == "reference frame") return std::nullopt;  // these two have no length
    const double step_mm = number_in<double>(*text).value_or(0) * ome_unit_mm(unit).value_or(0);
    if (step_mm > 0 && std::isfinite(step_mm)) return step_mm;
    throw Error(Fault::input, "input.frame",
                "'" + path_ + "' has the " + key + " " + quoted(*text) + " in " + quoted(unit) + ", which is no length",
                "correct it; units may be \xc2\xb5m, nm, mm, cm and m");
  }

 private:
  std::string_view pixels_;
  const std::string& path_;
};

}  // namespace

std::optional<OmePixels> ome_pixels(const std::string& description, const std::string& path) {
  if (tags_of(description, "OME").empty()) return std::nullopt;
  const std::vector<std::string_view> images = tags_of(description, "Pixels");
  if (images.size() != 1) {
    throw Error(Fault::input, "input.dimension",
                "'" + path + "' is an OME-TIFF whose header describes " + std::to_string(images.size()) + " images",
                "save one image as a stack of its own, which holds its description");
  }
  const Description pixels(images.front(), path);
  return OmePixels{pixels.size("SizeC"),
                   pixels.size("SizeT"),
                   pixels.size("SizeZ"),
                   {pixels.step_mm("X"), pixels.step_mm("Y"), pixels.step_mm("Z")}};
}

}  // namespace scantet
