#include "scantet/base/file_extension.h"

#include <cctype>
#include <filesystem>

namespace scantet {

std::string file_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace scantet
