// Tables differ in what stands beside label and name: colours, flags, codes. All of these are whole numbers, at places
// that tell the formats apart: FreeSurfer has four numbers behind the name, MRIcron one or none, ITK-SNAP a quoted name
// at the end. A table of BIDS has a first line that names its columns. Spreadsheets put a byte order mark before it.
#include "scantet/labels/label_names.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/base/regular_file.h"
#include "scantet/labels/label_words.h"

namespace scantet {
namespace {

struct NamedLabel {
  std::int64_t label;
  std::string name;
  std::optional<Color> color{};
};

/// The colour of three whole numbers in a row; nullopt if they are none, or no parts of a colour.
std::optional<Color> color_in(const std::vector<std::string>& words, std::size_t begin) {
  std::array<std::uint8_t, 3> parts{};
  if (begin + parts.size() > words.size()) return std::nullopt;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const auto part = whole_number(words[begin + n]);
    if (!part || *part < 0 || *part > 255) return std::nullopt;
    parts[n] = static_cast<std::uint8_t>(*part);
  }
  return Color{parts[0], parts[1], parts[2]};
}

/// The colour of "#a0b1c2".
std::optional<Color> hex_color(const std::string& text) {
  std::uint32_t bits = 0;
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  const auto [stop, code] = std::from_chars(text.data() + 1, text.data() + text.size(), bits, 16);
  if (code != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
  return Color{static_cast<std::uint8_t>(bits >> 16U), static_cast<std::uint8_t>(bits >> 8U & 255U),
               static_cast<std::uint8_t>(bits & 255U)};
}

std::string joined(const std::vector<std::string>& words, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t n = begin; n < end; ++n) text += (n == begin ? "" : " ") + words[n];
  return text;
}

/// The label and the name of a line of any table but one with columns; nullopt if it is no such line.
std::optional<NamedLabel> name_in(const std::string& line) {
  const std::vector<std::string> words = words_of(line);
  if (words.size() < 2) return std::nullopt;
  const auto label = whole_number(words[0]);
  if (!label) return std::nullopt;
  const std::size_t quote = line.find('"');
  if (const std::size_t end = line.rfind('"'); end != quote) {
    return NamedLabel{*label, line.substr(quote + 1, end - quote - 1), color_in(words, 1)};
  }
  std::size_t end = words.size();
  while (end > 2 && whole_number(words[end - 1])) --end;
  constexpr std::size_t kColours = 4;  // behind a name: red, green, blue, transparency
  const std::size_t numbers = words.size() - end;
  const bool code = numbers == 1 && end == 2;  // of MRIcron, behind a single word
  const bool coloured = numbers >= kColours;
  if (coloured) end = words.size() - kColours;  // a name may end in a number
  return NamedLabel{*label, joined(words, 1, coloured || code ? end : words.size()),
                    coloured ? color_in(words, end) : std::nullopt};
}

/// Where columns are parted by tabs: which one is called so.
std::optional<std::size_t> column_of(const std::vector<std::string>& columns, const std::string& name) {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

std::vector<std::string> columns_of(const std::string& line) {
  std::vector<std::string> columns;
  std::istringstream stream(line);
  for (std::string column; std::getline(stream, column, '\t');) {
    column.erase(column.find_last_not_of(" \r") + 1);
    columns.push_back(column);
  }
  return columns;
}

LabelTable table_in(std::istream& lines) {
  LabelTable table;
  std::optional<std::size_t> index;
  std::optional<std::size_t> name;
  std::optional<std::size_t> color;
  const auto put = [&](std::int64_t label, const std::string& text, const std::optional<Color>& its_color) {
    table.names[label] = text;
    if (its_color) table.colors[label] = *its_color;
  };
  std::string line;
  for (bool first = true; std::getline(lines, line); first = false) {
    if (first) {
      constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
      if (line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
      index = column_of(columns_of(line), "index");
      name = column_of(columns_of(line), "name");
      color = column_of(columns_of(line), "color");
      if (index && name) continue;
    }
    if (!index || !name) {
      if (const auto named = name_in(line)) put(named->label, named->name, named->color);
      continue;
    }
    const std::vector<std::string> columns = columns_of(line);
    if (columns.size() <= std::max(*index, *name)) continue;
    const bool coloured = color && *color < columns.size();
    if (const auto label = whole_number(columns[*index])) {
      put(*label, columns[*name], coloured ? hex_color(columns[*color]) : std::nullopt);
    }
  }
  return table;
}

/// The file's lines, if it is one.
LabelTable table_if_there(const std::string& path) {
  try {
    check_regular_file(path);
  } catch (const Error&) {
    return {};
  }
  std::ifstream file(path);
  return file ? table_in(file) : LabelTable();
}

/// The colours in a file of MRIcron: 256 reds, then greens, then blues; none if it is not as long as that.
std::map<std::int64_t, Color> colors_in_lut(const std::string& path) {
  constexpr std::size_t kColors = 256;
  try {
    check_regular_file(path);
  } catch (const Error&) {
    return {};
  }
  std::ifstream file(path, std::ios::binary);
  std::array<char, 3 * kColors + 1> bytes{};
  file.read(bytes.data(), bytes.size());
  if (file.gcount() != 3 * kColors) return {};
  std::map<std::int64_t, Color> colors;
  for (std::size_t n = 0; n < kColors; ++n) {
    colors[static_cast<std::int64_t>(n)] = {static_cast<std::uint8_t>(bytes[n]),
                                            static_cast<std::uint8_t>(bytes[kColors + n]),
                                            static_cast<std::uint8_t>(bytes[2 * kColors + n])};
  }
  return colors;
}

}  // namespace

LabelTable read_label_table(const std::string& path) {
  check_regular_file(path);
  std::ifstream file(path);
  if (!file)
    throw Error(Fault::input, "input.missing", "cannot open the table of labels '" + path + "'", "check the path");
  LabelTable table = table_in(file);
  if (table.names.empty()) {
    throw Error(Fault::input, "input.labels", "no line of '" + path + "' has a label and its name",
                "give a table of FreeSurfer, ITK-SNAP or BIDS, or lines such as \"17 Hippocampus\"");
  }
  return table;
}

std::vector<std::string> tables_beside(const std::string& image) {
  constexpr const char* kPacked = ".gz";
  const bool packed = image.size() > 3 && image.compare(image.size() - 3, 3, kPacked) == 0;
  const std::string stem = packed ? image.substr(0, image.size() - 3) : image;
  return {stem + ".txt", stem + ".lut"};
}

LabelTable table_beside(const std::string& image) {
  const std::vector<std::string> files = tables_beside(image);
  LabelTable table = table_if_there(files[0]);
  if (table.colors.empty()) table.colors = colors_in_lut(files[1]);
  return table;
}

LabelTable table_of_segments(const std::vector<ScanSegment>& segments) {
  LabelTable table;
  for (const ScanSegment& segment : segments) {
    if (!segment.name.empty()) table.names[segment.label] = segment.name;
    if (segment.color) table.colors[segment.label] = *segment.color;
  }
  return table;
}

}  // namespace scantet
