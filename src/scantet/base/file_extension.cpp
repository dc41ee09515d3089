// Only the letters of ASCII are made small: what std::tolower makes of other bytes depends on the locale.
#include "scantet/base/file_extension.h"

#include <filesystem>

namespace scantet {

std::string file_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace scantet
