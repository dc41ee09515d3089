// MetaIO copies words into blocks of 80 bytes and lines into blocks of 255, believes the lengths that a header states,
// and uses a file name as a format. So each line is looked at as strictly as the format is described: one key, known
// keys once and with as many numbers as they must have, short lines. Keys of other programs pass if they are short.
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

#include "scantet/base/ascii_text.h"
#include "scantet/base/numbered_files.h"
#include "scantet/reading/image_source_impl.h"
#include "scantet/reading/text_header_impl.h"

namespace scantet {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestLine = 254;
constexpr std::size_t kLongestWord = 79;
constexpr int kMostFiles = 10'000;

enum class Words { text, whole, real, axes, square };

// How many words a key has: any text, one whole number, one number, one a dimension, its square.
const std::map<std::string, Words>& known_keys() {
  static const std::map<std::string, Words> keys{
      {"ObjectType", Words::text},
      {"ObjectSubType", Words::text},
      {"TransformType", Words::text},
      {"Name", Words::text},
      {"Comment", Words::text},
      {"AcquisitionDate", Words::text},
      {"BinaryData", Words::text},
      {"BinaryDataByteOrderMSB", Words::text},
      {"ElementByteOrderMSB", Words::text},
      {"CompressedData", Words::text},
      {"AnatomicalOrientation", Words::text},
      {"DistanceUnits", Words::text},
      {"Modality", Words::text},
      {"ElementType", Words::text},
      {"ElementDataFile", Words::text},
      {"NDims", Words::whole},
      {"ID", Words::whole},
      {"ParentID", Words::whole},
      {"HeaderSize", Words::whole},
      {"CompressedDataSize", Words::whole},
      {"CompressionLevel", Words::whole},
      {"ElementNumberOfChannels", Words::whole},
      {"ElementMin", Words::real},
      {"ElementMax", Words::real},
      {"ElementToIntensityFunctionSlope", Words::real},
      {"ElementToIntensityFunctionOffset", Words::real},
      {"DimSize", Words::axes},
      {"ElementSpacing", Words::axes},
      {"ElementSize", Words::axes},
      {"Offset", Words::axes},
      {"Position", Words::axes},
      {"Origin", Words::axes},
      {"CenterOfRotation", Words::axes},
      {"TransformMatrix", Words::square},
      {"Rotation", Words::square},
      {"Orientation", Words::square},
  };
  return keys;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

template <class Number>
std::optional<Number> number_of(const std::string& word) {
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [stopped, failure] = std::from_chars(word.data() + (word[0] == '+' ? 1 : 0), end, number);
  return failure == std::errc() && stopped == end ? std::optional(number) : std::nullopt;
}

// One conversion of a whole number, "%03d" at most; start, end and step may follow the name.
bool is_sane_pattern(const std::vector<std::string>& words) {
  const std::string& name = words[0];
  std::size_t at = name.find('%') + 1;
  if (at < name.size() && name[at] == '0') ++at;
  if (at < name.size() && name[at] >= '1' && name[at] <= '9') ++at;
  if (at >= name.size() || name[at] != 'd' || name.find('%', at) != std::string::npos || words.size() > 4) return false;
  if (name.find('/', at) != std::string::npos) return false;
  std::vector<std::int64_t> range{1, 1, 1};
  for (std::size_t n = 1; n < words.size(); ++n) {
    const auto number = number_of<std::int32_t>(words[n]);
    if (!number || *number < 0) return false;
    range[n - 1] = *number;
  }
  return range[2] >= 1 && (range[1] - range[0]) / range[2] < kMostFiles;
}

class MetaHeader {
 public:
  MetaHeader(const std::string& path, const std::string& head) : path_(path), lines_(head) {}

  void check() {
    std::string line;
    while (std::getline(lines_, line)) {
      const std::size_t sign = line.find_first_of("=:");
      if (trimmed(line).empty()) continue;
      if (sign == std::string::npos) refuse("'" + line.substr(0, kLongestWord) + "' is no line of a header");
      check_characters(line);
      const std::string key(trimmed(std::string_view(line).substr(0, sign)));
      if (line.size() > kLongestLine || key.empty() || key.size() > kLongestWord) {
        refuse("the line of '" + key.substr(0, kLongestWord) + "' in its header is too long");
      }
      const std::string value(trimmed(std::string_view(line).substr(sign + 1)));
      if (value.starts_with('=') || value.starts_with(':'))
        refuse("the value of '" + key + "' begins with a separator");
      check_value(key, value);
      if (key == "ElementDataFile") return;
    }
    refuse("its header does not come to ElementDataFile");
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw corrupt_file(path_, what); }

  /// MetaIO takes more characters for blanks, and more for the end of a line, than are meant to be.
  void check_characters(const std::string& line) const {
    const auto is_odd = [&](const char& c) {
      const bool ends = c == '\r' && &c == &line.back();
      return static_cast<unsigned char>(c) < ' ' && c != '\t' && !ends;
    };
    if (std::any_of(line.begin(), line.end(), is_odd)) refuse("a line of its header has control characters");
  }

  void check_value(const std::string& key, const std::string& value) {
    const auto known = known_keys().find(key);
    if (known == known_keys().end()) return;
    if (++seen_[key] > 1) refuse(key + " stands twice in its header");
    const std::vector<std::string> words = words_of(value);
    if (known->second != Words::text) check_numbers(key, known->second, words);
    if (key == "ElementType" && (words.size() != 1 || value.rfind("MET_", 0) != 0 || value.size() > kLongestWord)) {
      refuse("its ElementType is no type: '" + value.substr(0, kLongestWord) + "'");
    }
    if (key == "ElementDataFile") check_files(value, words);
  }

  void check_numbers(const std::string& key, Words kind, const std::vector<std::string>& words) {
    if ((kind == Words::axes || kind == Words::square) && axes_ == 0) refuse(key + " stands before NDims");
    const std::size_t count = kind == Words::axes ? axes_ : kind == Words::square ? axes_ * axes_ : 1;
    if (words.size() != count) {
      refuse(key + " has " + std::to_string(words.size()) + " numbers instead of " + std::to_string(count));
    }
    const bool whole = kind == Words::whole || key == "DimSize";
    for (const std::string& word : words) {
      if (whole ? number_of<std::int64_t>(word).has_value() : number_of<double>(word).has_value()) continue;
      refuse(key + " states '" + word.substr(0, kLongestWord) + "', no number that it can be");
    }
    if (kind == Words::whole) check_whole(key, *number_of<std::int64_t>(words[0]));
  }

  void check_whole(const std::string& key, std::int64_t value) {
    constexpr std::int64_t kMostAxes = 7;
    constexpr std::int64_t kMostChannels = 1000;
    constexpr std::int64_t kMostBytes = std::int64_t{1} << 40;
    const std::int64_t least = key == "NDims" || key == "ElementNumberOfChannels" ? 1 : -1;
    const std::int64_t most = key == "NDims"                     ? kMostAxes
                              : key == "ElementNumberOfChannels" ? kMostChannels
                                                                 : kMostBytes;
    if (value < least || value > most) refuse(key + " cannot be " + std::to_string(value));
    if (key == "NDims") axes_ = static_cast<std::size_t>(value);
    if (key == "CompressedDataSize") compressed_bytes_ = value;
  }

  void check_files(const std::string& value, const std::vector<std::string>& words) {
    if (words.empty()) refuse("it names no ElementDataFile");
    if (value == "LOCAL" || value == "Local" || value == "local") {
      if (compressed_bytes_ <= static_cast<std::int64_t>(fs::file_size(path_))) return;
      refuse("it ends before its CompressedDataSize of " + std::to_string(compressed_bytes_) + " bytes does");
    }
    if (words[0] == "LIST") return check_list();
    if (words[0].starts_with("LIST")) refuse("its ElementDataFile begins with LIST: give the file another name");
    if (value.find('%') == std::string::npos) return check_voxel_file(path_, value);
    const bool short_words = std::all_of(words.begin(), words.end(), [](auto& w) { return w.size() <= kLongestWord; });
    if (!short_words || !is_sane_pattern(words)) {
      refuse("its ElementDataFile is no pattern of file names such as 'slice%03d.raw 1 90 1'");
    }
    check_voxel_file(path_, words[0]);
  }

  void check_list() {
    std::string line;
    for (int count = 0; std::getline(lines_, line); ++count) {
      const std::string name(trimmed(line));
      if (name.empty()) continue;
      if (name.size() > kLongestWord || count > kMostFiles)
        refuse("its list of files has too long a line, or too many");
      check_voxel_file(path_, name);
    }
  }

  const std::string& path_;
  std::istringstream lines_;
  std::size_t axes_ = 0;
  std::int64_t compressed_bytes_ = 0;
  std::map<std::string, int> seen_;
};

}  // namespace

void check_voxel_file(const std::string& path, const std::string& name) {
  const fs::path file = name;
  const bool leaves = file.is_absolute() || std::find(file.begin(), file.end(), "..") != file.end();
  if (leaves || name.size() > kLongestLine) {
    throw Error(Fault::input, "input.corrupt",
                "'" + path + "' names a file of voxels that is not beside it: '" + name.substr(0, kLongestWord) + "'",
                "put the file beside its header, and name it there");
  }
  const fs::path whole = fs::path(path).parent_path() / file;
  std::vector<fs::path> named = numbered_files(whole);
  named.push_back(whole);
  for (const fs::path& one : named) {
    std::error_code failure;
    const fs::file_status status = fs::status(one, failure);
    if (!fs::exists(status) || fs::is_regular_file(status)) continue;
    throw Error(Fault::input, "input.not_a_file",
                "'" + path + "' names voxels that are no file: '" + one.filename().string() + "'",
                "write what comes from it to a file first");
  }
}

void check_meta_header(const std::string& path, const std::string& head) {
  MetaHeader(path, head).check();
}

}  // namespace scantet
