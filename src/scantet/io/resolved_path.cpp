// The library resolves no link whose end is missing, so the last part of the path is followed here, link by link.
#include "scantet/io/resolved_path.h"

namespace scantet {

namespace fs = std::filesystem;

fs::path resolved_path(const std::string& path, std::error_code& failure) {
  constexpr int kMostLinks = 40;  // as the system
  fs::path target = fs::absolute(path, failure);
  if (failure) return path;
  std::error_code none;
  for (int links = 0; fs::is_symlink(fs::symlink_status(target, none)); ++links) {
    if (links == kMostLinks) {
      failure = std::make_error_code(std::errc::too_many_symbolic_link_levels);
      return target;
    }
    const fs::path next = fs::read_symlink(target, failure);
    if (failure) return target;
    target = target.parent_path() / next;
  }
  const fs::path folder = fs::weakly_canonical(target.parent_path(), none);
  return none ? target : folder / target.filename();
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code code;
  if (fs::equivalent(a, b, code) && !code) return true;
  std::error_code failure;
  const fs::path first = resolved_path(a, failure);
  return first == resolved_path(b, failure);
}

}  // namespace scantet
