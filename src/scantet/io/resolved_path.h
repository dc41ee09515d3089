// Which file a path stands for.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace scantet {

/// The file that writing to `path` would make: absolute, with every link followed, also one that leads to where nothing
/// is yet. If that fails (links in a circle), `failure` is set, and the path is returned as far as it was followed.
std::filesystem::path resolved_path(const std::string& path, std::error_code& failure);

/// Whether two paths stand for one file: for the same one that is there (so hard links count), or that would be made.
bool is_same_file(const std::string& a, const std::string& b);

}  // namespace scantet
