// Only file names are looked at here. A header that names files in a way that is not understood (lists, patterns)
// counts alone.
#include "scantet/io/input_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <optional>

#include "scantet/io/sha256.h"

namespace scantet {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// The voxel file that a text header names: "data file: x" in NRRD, "ElementDataFile = x" in MetaImage.
std::optional<fs::path> named_voxel_file(const fs::path& header) {
  constexpr int kHeaderLines = 1000;
  std::ifstream stream(header);
  std::string line;
  for (int i = 0; i < kHeaderLines && std::getline(stream, line); ++i) {
    const std::size_t separator = line.find_first_of(":=");
    if (separator == std::string::npos) continue;
    const std::string key = lower(trimmed(line.substr(0, separator)));
    if (key == "data file" || key == "datafile" || key == "elementdatafile") {
      return header.parent_path() / trimmed(line.substr(separator + 1));
    }
  }
  return std::nullopt;
}

std::optional<fs::path> voxel_file(const fs::path& file) {
  const std::string extension = lower(file.extension().string());
  if (extension == ".nhdr" || extension == ".mhd") return named_voxel_file(file);
  if (extension == ".hdr") return fs::path(file).replace_extension(".img");
  if (extension == ".img") return fs::path(file).replace_extension(".hdr");
  return std::nullopt;
}

}  // namespace

std::vector<std::string> input_files(const std::string& input) {
  std::error_code code;
  fs::path path = input;
  const std::size_t colon = input.rfind(':');
  if (!fs::exists(path, code) && colon != std::string::npos) path = input.substr(0, colon);
  std::vector<std::string> files;
  if (fs::is_directory(path, code)) {
    for (const auto& entry : fs::directory_iterator(path, code)) {
      if (entry.is_regular_file(code)) files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    return files;
  }
  files.push_back(path.string());
  const auto voxels = voxel_file(path);
  if (voxels && fs::is_regular_file(*voxels, code)) files.push_back(voxels->string());
  std::sort(files.begin(), files.end());
  return files;
}

std::string input_sha256(const std::vector<std::string>& files) {
  if (files.size() == 1) return sha256_file(files.front());
  std::string lines;
  for (const std::string& file : files) {
    lines += sha256_file(file) + "  " + fs::path(file).filename().string() + "\n";
  }
  return sha256_text(lines);
}

}  // namespace scantet
