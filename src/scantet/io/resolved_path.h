// Which file a path stands for.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace scantet {

/// Absolute, with every link followed, also one that leads to where nothing is yet: the file that writing to `path`
/// would make. On failure (links in a circle) `failure` is set; what is returned is as far as it went.
std::filesystem::path resolved_path(const std::string& path, std::error_code& failure);

/// Whether two paths stand for one file: by what is there (so hard links count), or would be.
bool is_same_file(const std::string& a, const std::string& b);

}  // namespace scantet
