// Control groups are looked for in both versions, each from the process's own group up to the root.
#include "scantet/base/memory.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace scantet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The number in a file; infinite if there is none ("max").
double number_in(const std::string& file) {
  std::ifstream stream(file);
  double number = kInfinity;
  if (!(stream >> number)) return kInfinity;
  return number;
}

/// The memory that a group and those above it leave. root: where its hierarchy is mounted; group: "/a/b".
double left_by_groups(const std::string& root, std::string group, const char* limit_file, const char* usage_file) {
  double left = kInfinity;
  while (true) {
    const std::string folder = root + group + "/";
    const double limit = number_in(folder + limit_file);
    const double used = number_in(folder + usage_file);
    if (limit < kInfinity && used < kInfinity) left = std::min(left, std::max(0.0, limit - used));
    if (group.empty() || group == "/") return left;
    group.resize(std::min(group.rfind('/'), group.size()));
  }
}

double left_by_control_groups() {
  std::ifstream stream("/proc/self/cgroup");  // lines of "4:memory:/a/b", or "0::/a/b"
  double left = kInfinity;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string group = line.substr(second + 1);
    if (controllers.empty()) {
      left = std::min(left, left_by_groups("/sys/fs/cgroup", group, "memory.max", "memory.current"));
    } else if (controllers.find("memory") != std::string::npos) {
      left = std::min(left,
                      left_by_groups("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes", "memory.usage_in_bytes"));
    }
  }
  return left;
}

}  // namespace

double resident_bytes() {
  std::ifstream stream("/proc/self/statm");
  double total = 0;
  double resident = 0;
  if (!(stream >> total >> resident)) return 0;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double physical_bytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

double available_bytes() {
  constexpr double kKibibyte = 1024;
  double available = kInfinity;
  std::ifstream stream("/proc/meminfo");
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string name;
    double kibibytes = 0;
    if (words >> name >> kibibytes && name == "MemAvailable:") available = kibibytes * kKibibyte;
  }
  return std::min(available, left_by_control_groups());
}

}  // namespace scantet
