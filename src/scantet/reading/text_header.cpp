// The three formats write their sizes on a line of its own, "sizes: 3 4 5", "DimSize = 3 4 5", "DIMENSIONS 3 4 5",
// among the first lines of the file. What else MetaImage headers are checked for is in meta_header.
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "scantet/base/ascii_text.h"
#include "scantet/base/file_extension.h"
#include "scantet/reading/image_source_impl.h"
#include "scantet/reading/nrrd_voxels_impl.h"
#include "scantet/reading/text_header_impl.h"

namespace scantet {
namespace {

constexpr std::size_t kLongestHead = 1 << 20;

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
  std::string text = ascii_lower(line);
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

void check_nrrd_pattern(const std::string& path, const std::string& value) {
  const std::optional<NrrdPattern> pattern = nrrd_pattern(value);
  if (!pattern) throw corrupt_file(path, "its data file is no pattern of file names such as 'slice%03d.raw 1 90 1'");
  check_voxel_file(path, pattern->name);
}

// A field is a line; only pairs of key and value may be long. Detached voxels are in a file, in files by a pattern
// ("x%03d.raw 1 90 1"), or in those listed up to the end.
void check_nrrd_lines(const std::string& path, const std::string& head) {
  constexpr std::size_t kLongestField = 4096;
  constexpr std::size_t kMostFiles = 10'000;
  std::istringstream lines(head);
  std::string line;
  bool list = false;
  for (std::size_t files = 0; std::getline(lines, line);) {
    const bool end = line.empty() || line == "\r";
    if (end && !list) return;
    if (const std::size_t at = line.find('\r'); at != std::string::npos && at + 1 < line.size()) {
      throw corrupt_file(path, "a line of its header ends in a carriage return alone");  // one line here, two in NrrdIO
    }
    if (line.find(":=") == std::string::npos && line.size() > kLongestField) {
      throw corrupt_file(path, "a line of its header is " + std::to_string(line.size()) + " bytes long");
    }
    if (list && ++files > kMostFiles) throw corrupt_file(path, "its header lists too many files");
    const std::string text = normalised(line);
    const std::size_t value = text.rfind("data file:", 0) == 0 ? 10 : text.rfind("datafile:", 0) == 0 ? 9 : 0;
    if (!list && value == 0) continue;
    std::istringstream words(line.substr(list ? 0 : value));
    std::string name;
    std::getline(words >> std::ws, name);
    name.erase(name.find_last_not_of(" \t\r") + 1);
    if (!list && name.find('%') != std::string::npos) {
      check_nrrd_pattern(path, name);
    } else if (list || name.rfind("LIST", 0) != 0) {
      check_voxel_file(path, name);
    }
    list = list || name.rfind("LIST", 0) == 0;
  }
  if (head.size() >= kLongestHead) throw corrupt_file(path, "its header has no end in the first MiB");
}

// ITK's reader of VTK files has room for 256 bytes a line.
void check_vtk_lines(const std::string& path, const std::string& head) {
  constexpr std::size_t kLongestLine = 255;
  constexpr int kHeaderLines = 12;
  std::istringstream lines(head);
  std::string line;
  for (int count = 0; count < kHeaderLines && std::getline(lines, line); ++count) {
    const std::string text = normalised(line);
    if (line.size() > kLongestLine) throw corrupt_file(path, "a line of its header is too long");
    if (text.rfind("lookup_table", 0) == 0 || text.rfind("scalars", 0) == 0) return;
  }
}

bool has_extension(const std::string& path, std::initializer_list<const char*> extensions) {
  return std::find(extensions.begin(), extensions.end(), file_extension(path)) != extensions.end();
}

}  // namespace

void check_text_header(const std::string& path) {
  const std::string head = first_bytes(path, kLongestHead);
  if (head.rfind("NRRD", 0) == 0) {
    check_lines(path, head, kNrrd);
    check_nrrd_lines(path, head);
  } else if (head.rfind("# vtk", 0) == 0) {
    check_lines(path, head, kVtk);
    check_vtk_lines(path, head);
  } else if (has_extension(path, {".mha", ".mhd"}) && head.find("NDims") != std::string::npos) {
    check_lines(path, head, kMeta);
    check_meta_header(path, head);
  }
}

}  // namespace scantet
