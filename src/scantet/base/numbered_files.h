// The files that a header names by a pattern, such as "slice%03d.raw 1 90 1".
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace scantet {

/// What is in the pattern's folder, be it a file or not, and has its name with any number in the place of "%...d". More
/// than the pattern means, which also has a first and a last number. Empty if it has no such place, or no folder.
inline std::vector<std::filesystem::path> numbered_files(const std::filesystem::path& pattern) {
  const std::string name = pattern.filename().string();
  const std::size_t percent = name.find('%');
  const std::size_t end = percent == std::string::npos ? percent : name.find('d', percent);
  if (end == std::string::npos) return {};
  const std::string before = name.substr(0, percent);
  const std::string behind = name.substr(end + 1);
  const auto is_one = [&](const std::string& other) {
    if (other.size() <= before.size() + behind.size()) return false;
    const auto first = other.begin() + static_cast<std::ptrdiff_t>(before.size());
    const auto last = other.end() - static_cast<std::ptrdiff_t>(behind.size());
    return other.starts_with(before) && other.ends_with(behind) &&
           std::all_of(first, last, [](char c) { return (c >= '0' && c <= '9') || c == '-' || c == ' '; });
  };
  std::vector<std::filesystem::path> files;
  std::error_code failure;
  const std::filesystem::path folder = pattern.has_parent_path() ? pattern.parent_path() : ".";
  for (std::filesystem::directory_iterator entry(folder, failure), none; !failure && entry != none;
       entry.increment(failure)) {
    if (is_one(entry->path().filename().string())) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace scantet
