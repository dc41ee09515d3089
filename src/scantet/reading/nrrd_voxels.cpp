// A gzip file ends with its length before compression, modulo 2³², unless it has several members or something behind
// it. Where that is not the length asked for, the bytes are counted.
#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "scantet/base/ascii_text.h"
#include "scantet/reading/image_source_impl.h"
#include "scantet/reading/nifti_header_impl.h"
#include "scantet/reading/nrrd_voxels_impl.h"

namespace scantet {
namespace {

/// Where the voxels are.
struct Voxels {
  std::vector<std::string> files;
  std::uint64_t begin = 0;  // in the first
  std::string encoding;
};

/// The files that a pattern stands for, which check_text_header() has seen.
std::vector<std::string> files_of_pattern(const std::string& value) {
  const std::optional<NrrdPattern> pattern = nrrd_pattern(value);
  if (!pattern) return {};
  const std::string format = pattern->name.substr(pattern->percent + 1, pattern->end - pattern->percent - 1);
  const std::size_t width = format.empty() ? 0 : static_cast<std::size_t>(std::atoi(format.c_str()));
  const char fill = format.starts_with('0') ? '0' : ' ';
  std::vector<std::string> files;
  for (double n = pattern->from; pattern->step > 0 ? n <= pattern->to : n >= pattern->to; n += pattern->step) {
    std::string number = std::to_string(static_cast<std::int64_t>(n));
    if (number.size() < width) number.insert(0, width - number.size(), fill);
    files.push_back(pattern->name.substr(0, pattern->percent) + number + pattern->name.substr(pattern->end + 1));
  }
  return files;
}

/// The lines that are left of a header, up to an empty one.
std::vector<std::string> listed_files(std::istream& lines) {
  std::vector<std::string> files;
  for (std::string line; std::getline(lines, line) && !trimmed(line).empty();) files.emplace_back(trimmed(line));
  return files;
}

Voxels voxels_of(const std::string& path) {
  constexpr std::size_t kLongestHead = 1 << 20;
  std::istringstream lines(first_bytes(path, kLongestHead));
  Voxels voxels{{path}, 0, ""};
  for (std::string line; std::getline(lines, line);) {
    voxels.begin += line.size() + 1;
    if (line.empty() || line == "\r") break;
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    const std::string key = ascii_lower(line.substr(0, colon));
    const std::string value(trimmed(std::string_view(line).substr(colon + 1)));
    if (key == "encoding") voxels.encoding = ascii_lower(value);
    if (key != "data file" && key != "datafile") continue;
    const bool is_list = value.rfind("LIST", 0) == 0;
    const bool is_pattern = value.find('%') != std::string::npos;
    voxels.files = is_list      ? listed_files(lines)
                   : is_pattern ? files_of_pattern(value)
                                : std::vector<std::string>{value};
    for (std::string& file : voxels.files) file = (std::filesystem::path(path).parent_path() / file).string();
  }
  if (voxels.files != std::vector<std::string>{path}) voxels.begin = 0;
  return voxels;
}

/// The last four bytes of a file, the least first.
std::uint32_t last_number(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<unsigned char, 4> bytes{};
  in.seekg(-4, std::ios::end);
  in.read(reinterpret_cast<char*>(bytes.data()), 4);
  return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

/// Of all files together, from where the voxels begin; those that are not there have none.
std::uint64_t size_of(const Voxels& voxels) {
  std::uint64_t sum = 0;
  for (const std::string& file : voxels.files) {
    std::error_code code;
    const std::uint64_t bytes = std::filesystem::file_size(file, code);
    if (!code) sum += bytes;
  }
  return sum > voxels.begin ? sum - voxels.begin : 0;
}

/// How many bytes there are in one file when decompressed, or `enough` if there are more.
std::uint64_t length_of(const Voxels& voxels, std::uint64_t enough) {
  const int descriptor = open(voxels.files.front().c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return 0;
  const bool is_there = lseek(descriptor, static_cast<off_t>(voxels.begin), SEEK_SET) >= 0;
  const GzPointer file(gzdopen(descriptor, "rb"));
  if (!file) close(descriptor);
  if (!file || !is_there) return 0;
  std::vector<unsigned char> some(1 << 18);
  std::uint64_t length = 0;
  for (int got = 1; got > 0 && length < enough; length += static_cast<std::uint64_t>(std::max(got, 0))) {
    got = gzread(file.get(), some.data(), static_cast<unsigned>(some.size()));
  }
  return std::min(length, enough);
}

}  // namespace

std::optional<NrrdPattern> nrrd_pattern(const std::string& value) {
  constexpr double kMostFiles = 10'000;
  std::istringstream words(value);
  NrrdPattern p{"", 0, 0, 0, 0, 0};
  words >> p.name >> p.from >> p.to >> p.step;
  p.percent = p.name.find('%');
  if (!words || p.percent == std::string::npos) return std::nullopt;
  p.end = p.name.find_first_not_of("0123456789", p.percent + 1);
  const bool sane = p.end != std::string::npos && p.end <= p.percent + 3 && p.name[p.end] == 'd' &&
                    p.name.find('%', p.end) == std::string::npos && p.name.find('/', p.percent) == std::string::npos;
  if (!sane || !(p.step != 0) || !((p.to - p.from) / p.step < kMostFiles)) return std::nullopt;
  return p;
}

void check_nrrd_voxels(const std::string& path, std::uint64_t bytes, std::uint64_t numbers) {
  const Voxels voxels = voxels_of(path);
  const bool is_one = voxels.files.size() == 1;
  if (is_one && !std::filesystem::exists(voxels.files.front())) return;  // Teem says what is wrong
  const std::uint64_t present = size_of(voxels);
  const auto check = [&](std::uint64_t there, std::uint64_t wanted, const char* what) {
    if (there >= wanted) return;
    throw corrupt_file(path, "its header asks for " + std::to_string(wanted) + " bytes of voxels" + what + ", and " +
                                 std::to_string(there) + " are there");
  };
  if (voxels.encoding == "raw") {
    check(present, bytes, "");
  } else if (voxels.encoding == "gzip" || voxels.encoding == "gz") {
    constexpr std::uint64_t kMostShrinking = 1032;  // deflate's
    check(present * kMostShrinking, bytes, " at most");
    if (is_one && last_number(voxels.files.front()) != static_cast<std::uint32_t>(bytes))
      check(length_of(voxels, bytes), bytes, "");
  } else if (voxels.encoding == "hex") {  // two digits a byte
    check(present / 2, bytes, "");
  } else if (voxels.encoding == "ascii" || voxels.encoding == "text" || voxels.encoding == "txt") {
    check((present + voxels.files.size()) / 2, numbers, " at least");  // a digit for each number, and a gap between
  }
}

}  // namespace scantet
