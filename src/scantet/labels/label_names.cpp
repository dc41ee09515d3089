// Tables differ in what stands beside label and name: colours, flags, codes. All of these are whole numbers, at places
// that tell the formats apart: FreeSurfer has four numbers behind the name, MRIcron one or none, ITK-SNAP a quoted name
// at the end. A table of BIDS has a first line that names its columns.
#include "scantet/labels/label_names.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/base/regular_file.h"
#include "scantet/labels/label_words.h"

namespace scantet {
namespace {

struct NamedLabel {
  std::int64_t label;
  std::string name;
};

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
    return NamedLabel{*label, line.substr(quote + 1, end - quote - 1)};
  }
  std::size_t end = words.size();
  while (end > 2 && whole_number(words[end - 1])) --end;
  constexpr std::size_t kColours = 4;  // behind a name: red, green, blue, transparency
  const std::size_t numbers = words.size() - end;
  const bool code = numbers == 1 && end == 2;  // of MRIcron, behind a single word
  return NamedLabel{*label, joined(words, 1, numbers >= kColours || code ? end : words.size())};
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

LabelNames names_in(std::istream& lines) {
  LabelNames names;
  std::optional<std::size_t> index;
  std::optional<std::size_t> name;
  std::string line;
  for (bool first = true; std::getline(lines, line); first = false) {
    if (first) {
      index = column_of(columns_of(line), "index");
      name = column_of(columns_of(line), "name");
      if (index && name) continue;
    }
    if (!index || !name) {
      if (const auto named = name_in(line)) names[named->label] = named->name;
      continue;
    }
    const std::vector<std::string> columns = columns_of(line);
    if (columns.size() <= std::max(*index, *name)) continue;
    if (const auto label = whole_number(columns[*index])) names[*label] = columns[*name];
  }
  return names;
}

}  // namespace

LabelNames read_label_names(const std::string& path) {
  check_regular_file(path);
  std::ifstream file(path);
  if (!file) throw Error(Fault::input, "input.missing", "cannot open the table of labels '" + path + "'");
  LabelNames names = names_in(file);
  if (names.empty()) {
    throw Error(Fault::input, "input.labels", "no line of '" + path + "' has a label and its name",
                "give a table of FreeSurfer, ITK-SNAP or BIDS, or lines such as \"17 Hippocampus\"");
  }
  return names;
}

LabelNames names_beside(const std::string& image) {
  constexpr const char* kPacked = ".gz";
  const bool packed = image.size() > 3 && image.compare(image.size() - 3, 3, kPacked) == 0;
  const std::string path = (packed ? image.substr(0, image.size() - 3) : image) + ".txt";
  try {
    check_regular_file(path);
  } catch (const Error&) {
    return {};
  }
  std::ifstream file(path);
  return file ? names_in(file) : LabelNames();
}

LabelNames names_of_segments(const std::string& image) {
  constexpr int kMostLines = 20'000;
  constexpr std::streamsize kLongest = 1 << 16;
  std::ifstream file(image, std::ios::binary);
  std::map<std::string, std::string> name_of;  // by segment, "Segment0"
  std::map<std::string, std::int64_t> label_of;
  std::vector<char> buffer(kLongest);
  for (int n = 0; n < kMostLines && file.getline(buffer.data(), kLongest); ++n) {
    std::string line(buffer.data());
    line.erase(line.find_last_not_of('\r') + 1);
    if (line.empty() || (n == 0 && line.rfind("NRRD", 0) != 0)) break;
    const std::size_t sign = line.find(":=");
    const std::size_t part = line.find('_');
    if (line.rfind("Segment", 0) != 0 || sign == std::string::npos || part == std::string::npos || part > sign)
      continue;
    const std::string segment = line.substr(0, part);
    const std::string key = line.substr(part + 1, sign - part - 1);
    const std::string value = line.substr(sign + 2);
    if (key == "Name") name_of[segment] = value;
    const auto label = whole_number(value);
    if (key == "LabelValue" && label) label_of[segment] = *label;
  }
  LabelNames names;
  for (const auto& [segment, label] : label_of) {
    if (name_of.count(segment) > 0) names[label] = name_of[segment];
  }
  return names;
}

}  // namespace scantet
