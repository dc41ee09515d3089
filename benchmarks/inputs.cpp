#include "inputs.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <vector>

#include "scantet/app/built_in_plugins.h"
#include "scantet/plugin/plugin_check.h"
#include "scantet/plugin/plugin_loader.h"
#include "tanglecube.h"

namespace scantet::bench {
namespace {

constexpr const char* kArchive = "/usr/share/doc/libcgal-dev/data.tar.gz";

/// Whether the program, looked for along PATH, ran and ended with status 0.
bool succeeds(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  int status = 0;
  return posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) == 0 &&
         waitpid(child, &status, 0) == child && status == 0;
}

/// Made when it is asked for.
std::filesystem::path unpacked_folder() {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "scantet_benchmarks";
  std::filesystem::create_directories(folder);
  return folder;
}

double torus(const Point& p) {  // a ring of 1 mm with a tube of 0.4 mm
  const double around = p.x * p.x + p.y * p.y;
  const double sum = around + p.z * p.z + 0.84;
  return sum * sum - 4 * around;
}

double gyroid(const Point& p) {
  const double share = (p.x * p.x + p.y * p.y + p.z * p.z) / 25;
  const double fourth = share * share * share * share;
  return std::sin(p.x) * std::cos(p.y) + std::sin(p.y) * std::cos(p.z) + std::sin(p.z) * std::cos(p.x) +
         fourth * fourth;
}

}  // namespace

OpenedDomain open_input(const std::string& input, const std::vector<std::pair<std::string, std::string>>& options) {
  PluginRegistry plugins = built_in_plugins();
  for (const std::string& warning : load_plugin_folder(plugin_folder(), plugins)) {
    std::fprintf(stderr, "%s\n", warning.c_str());
  }
  const std::unique_ptr<InputPlugin> plugin = plugins.create_for(input);
  OptionSet set;
  plugin->declare_options(set);
  for (const auto& [name, value] : options) set.set({name, value, "--" + name});
  Progress progress;
  return open_checked(*plugin, input, progress);
}

std::string cgal_data_file(const std::string& member) {
  const std::filesystem::path folder = unpacked_folder();
  const std::string inside = "data/" + member;
  if (!std::filesystem::exists(folder / inside) && !succeeds({"tar", "-xzf", kArchive, "-C", folder, inside})) {
    throw std::runtime_error("cannot unpack " + inside + " from " + kArchive + "; install Debian's libcgal-demo");
  }
  return folder / inside;
}

bool has_cgal_data() {
  return std::filesystem::exists(kArchive);
}

std::string head_ct_file() {
  const std::filesystem::path file = unpacked_folder() / "head_ct.nrrd";
  if (!std::filesystem::exists(file) && !succeeds({"python3", SCANTET_HEAD_CT, file})) {
    throw std::runtime_error(std::string("cannot unpack ") + kHeadCtArchive);
  }
  return file;
}

ImplicitFunction implicit_function(const std::string& name) {
  static const std::map<std::string, ImplicitFunction> functions{
      {"torus", torus}, {"tanglecube", tanglecube}, {"gyroid", gyroid}};
  const auto found = functions.find(name);
  if (found == functions.end()) throw std::runtime_error("there is no function for " + name);
  return found->second;
}

}  // namespace scantet::bench
