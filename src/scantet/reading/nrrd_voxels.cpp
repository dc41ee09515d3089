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

#include "scantet/reading/image_source_impl.h"
#include "scantet/reading/nifti_header_impl.h"
#include "scantet/reading/nrrd_voxels_impl.h"

namespace scantet {
namespace {

/// Where the voxels are.
struct Voxels {
  std::string file;  // empty: in several
  std::uint64_t begin = 0;
  std::string encoding;
};

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

Voxels voxels_of(const std::string& path) {
  constexpr std::size_t kLongestHead = 1 << 20;
  std::istringstream lines(first_bytes(path, kLongestHead));
  Voxels voxels{path, 0, ""};
  for (std::string line; std::getline(lines, line);) {
    voxels.begin += line.size() + 1;
    if (line.empty() || line == "\r") break;
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    std::string key = line.substr(0, colon);
    std::transform(key.begin(), key.end(), key.begin(), [](unsigned char c) { return std::tolower(c); });
    const std::string value = trimmed(line.substr(colon + 1));
    if (key == "encoding") voxels.encoding = value;
    if (key != "data file" && key != "datafile") continue;
    const bool several = value.find('%') != std::string::npos || value.rfind("LIST", 0) == 0;
    voxels.file = several ? "" : (std::filesystem::path(path).parent_path() / value).string();
  }
  std::transform(voxels.encoding.begin(), voxels.encoding.end(), voxels.encoding.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (voxels.file != path) voxels.begin = 0;
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

/// How many bytes there are when decompressed, or `enough` if there are more.
std::uint64_t length_of(const Voxels& voxels, std::uint64_t enough) {
  const int descriptor = open(voxels.file.c_str(), O_RDONLY | O_CLOEXEC);
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

void check_nrrd_voxels(const std::string& path, std::uint64_t bytes, std::uint64_t numbers) {
  const Voxels voxels = voxels_of(path);
  std::error_code code;
  const std::uint64_t whole = voxels.file.empty() ? 0 : std::filesystem::file_size(voxels.file, code);
  if (voxels.file.empty() || code) return;  // Teem says what is wrong
  const std::uint64_t present = whole > voxels.begin ? whole - voxels.begin : 0;
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
    if (last_number(voxels.file) != static_cast<std::uint32_t>(bytes)) check(length_of(voxels, bytes), bytes, "");
  } else if (voxels.encoding == "hex") {  // two digits a byte
    check(present / 2, bytes, "");
  } else if (voxels.encoding == "ascii" || voxels.encoding == "text" || voxels.encoding == "txt") {
    check((present + 1) / 2, numbers, " at least");  // a digit for each number, and a gap between
  }
}

}  // namespace scantet
