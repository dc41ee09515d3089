// The three formats write their sizes on a line of its own, "sizes: 3 4 5", "DimSize = 3 4 5", "DIMENSIONS 3 4 5",
// among the first lines of the file.
#include <cctype>
#include <cmath>
#include <limits>
#include <sstream>

#include "scantet/image/image_source_impl.h"
#include "scantet/image/text_header_impl.h"

namespace scantet {
namespace {

constexpr int kMostAxes = 7;

struct Entry {
  const char* key;  // lower case
  bool counts_axes;
};
constexpr Entry kNrrd[] = {{"dimension:", true}, {"sizes:", false}};
constexpr Entry kMeta[] = {{"ndims=", true}, {"dimsize=", false}};
constexpr Entry kVtk[] = {{"dimensions ", false}};

// Lower case, "key = value" written "key=value".
std::string normalised(const std::string& line) {
  std::string text;
  for (const char c : line) text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos) return text;
  const std::size_t end = text.find_last_not_of(" \t", sign == 0 ? 0 : sign - 1);
  return end == std::string::npos ? text : text.substr(0, end + 1) + text.substr(sign);
}

void check_axis_count(const std::string& path, double value) {
  if (value >= 1 && value <= kMostAxes) return;
  std::ostringstream message;
  message << "'" << path << "' states " << value << " axes";
  throw Error(Fault::input, "input.dimension", message.str(), "give a three-dimensional image");
}

void check_axis_size(const std::string& path, double value) {
  std::ostringstream message;
  message << "'" << path << "' states an axis of " << value << " voxels";
  if (!(value >= 1)) throw corrupt_file(path, "the header states an axis of " + std::to_string(value) + " voxels");
  if (value > std::numeric_limits<int>::max()) {
    throw Error(Fault::input, "input.too_large", message.str(), "correct the header, or crop the image");
  }
}

void check_line(const std::string& path, const Entry& entry, const std::string& values) {
  std::istringstream stream(values);
  std::string word;
  int count = 0;
  while (stream >> word) {
    std::istringstream number(word);
    number.imbue(std::locale::classic());
    double value = 0;
    if (!(number >> value)) throw corrupt_file(path, "'" + word + "' stands where the header should give a size");
    entry.counts_axes ? check_axis_count(path, value) : check_axis_size(path, value);
    ++count;
  }
  if (count > kMostAxes) check_axis_count(path, count);
}

template <std::size_t N>
void check_lines(const std::string& path, const std::string& head, const Entry (&entries)[N]) {
  std::istringstream lines(head);
  std::string line;
  while (std::getline(lines, line)) {
    const std::string text = normalised(line);
    if (text.empty() || text == "\r" || text.rfind("elementdatafile=", 0) == 0) return;  // voxels follow
    for (const Entry& entry : entries) {
      const std::string key = entry.key;
      if (text.rfind(key, 0) == 0) check_line(path, entry, text.substr(key.size()));
    }
  }
}

}  // namespace

void check_text_header(const std::string& path) {
  constexpr std::size_t kLongestHead = 1 << 16;
  const std::string head = first_bytes(path, kLongestHead);
  if (head.rfind("NRRD", 0) == 0) {
    check_lines(path, head, kNrrd);
  } else if (head.rfind("# vtk", 0) == 0) {
    check_lines(path, head, kVtk);
  } else if (const std::string start = normalised(head.substr(0, 4096)); start.find("ndims") != std::string::npos) {
    check_lines(path, head, kMeta);
  }
}

}  // namespace scantet
