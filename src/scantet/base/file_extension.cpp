#include "scantet/base/file_extension.h"

#include <filesystem>

#include "scantet/base/ascii_text.h"

namespace scantet {

std::string file_extension(const std::string& path) {
  return ascii_lower(std::filesystem::path(path).extension().string());
}

}  // namespace scantet
