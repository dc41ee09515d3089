// Only names are looked at here, and the text of headers.
#include "scantet/io/input_files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scantet/base/ascii_text.h"
#include "scantet/base/numbered_files.h"
#include "scantet/io/sha256.h"

namespace scantet {
namespace {

namespace fs = std::filesystem;

// The first part of a file, which its header does not exceed; empty of what is no regular file.
std::string head_of(const fs::path& file) {
  constexpr std::size_t kLongestHead = 1 << 20;
  std::error_code code;
  if (!fs::is_regular_file(file, code)) return {};
  std::ifstream stream(file, std::ios::binary);
  std::string head(kLongestHead, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return head;
}

// The voxel files that a text header names: "data file: x" in NRRD, "ElementDataFile = x" in MetaImage; x may be a
// pattern, or LIST with the names behind it.
std::vector<fs::path> named_voxel_files(const fs::path& header) {
  std::istringstream lines(head_of(header));
  const fs::path folder = header.parent_path();
  std::vector<fs::path> files;
  for (std::string line; std::getline(lines, line) && !trimmed(line).empty();) {
    const std::size_t separator = line.find_first_of(":=");
    if (separator == std::string::npos) continue;
    const std::string key = ascii_lower(trimmed(std::string_view(line).substr(0, separator)));
    if (key != "data file" && key != "datafile" && key != "elementdatafile") continue;
    const std::string name(trimmed(std::string_view(line).substr(separator + 1)));
    if (name.starts_with("LIST")) {
      while (std::getline(lines, line)) files.push_back(folder / trimmed(line));
    } else if (name.find('%') != std::string::npos) {
      files = numbered_files(folder / name.substr(0, name.find_first_of(" \t")));
    } else {
      files = {folder / name};
    }
    break;
  }
  return files;
}

// Beside the file itself, as far as their names go.
std::vector<fs::path> voxel_files(const fs::path& file) {
  const std::string extension = ascii_lower(file.extension().string());
  const auto renamed = [&](const char* other) { return fs::path(file).replace_extension(other); };
  if (extension == ".nhdr" || extension == ".mhd" || extension == ".nrrd" || extension == ".mha")
    return named_voxel_files(file);
  if (extension == ".hdr") return {renamed(".img"), renamed(".img.gz")};
  if (extension == ".img") return {renamed(".hdr")};
  if (extension == ".gz" && ascii_lower(file.stem().extension().string()) == ".img")
    return {fs::path(file).replace_extension().replace_extension(".hdr")};
  return {};
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
  for (const fs::path& voxels : voxel_files(path)) {
    if (fs::is_regular_file(voxels, code)) files.push_back(voxels.string());
  }
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
