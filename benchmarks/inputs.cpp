#include "inputs.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

#include "scantet/app/built_in_plugins.h"
#include "scantet/plugin/plugin_check.h"
#include "scantet/plugin/plugin_loader.h"
#include "tanglecube.h"

namespace scantet::bench {
namespace {

constexpr const char* kArchive = "/usr/share/doc/libcgal-dev/data.tar.gz";

/// package: of Debian, that has the archive.
void unpack(const char* archive, const std::string& member, const std::filesystem::path& folder, const char* package) {
  std::filesystem::create_directories(folder);
  std::array<const char*, 7> arguments{"tar", "-xzf", archive, "-C", folder.c_str(), member.c_str(), nullptr};
  pid_t tar = 0;
  int status = 0;
  if (posix_spawnp(&tar, "tar", nullptr, nullptr, const_cast<char* const*>(arguments.data()), environ) != 0 ||
      waitpid(tar, &status, 0) != tar || status != 0) {
    throw std::runtime_error("cannot unpack " + member + " from " + archive + "; install Debian's " + package);
  }
}

std::filesystem::path unpacked_folder() {
  return std::filesystem::temp_directory_path() / "scantet_benchmarks";
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
  const std::filesystem::path file = unpacked_folder() / "data" / member;
  if (!std::filesystem::exists(file)) unpack(kArchive, "data/" + member, unpacked_folder(), "libcgal-demo");
  return file.string();
}

bool has_cgal_data() {
  return std::filesystem::exists(kArchive);
}

std::string head_ct_file() {
  const std::string voxels = "tmpocjcea/matrix.dat";
  const std::filesystem::path header = unpacked_folder() / "head_ct.nhdr";
  if (std::filesystem::exists(header)) return header.string();
  unpack(kHeadCtArchive, voxels, unpacked_folder(), "invesalius-examples");
  std::ofstream out(header);
  out << "NRRD0004\ntype: short\ndimension: 3\nsizes: 256 256 108\nspace: left-posterior-superior\n"
      << "space directions: (0.9570312,0,0) (0,0.9570312,0) (0,0,1.5)\nspace origin: (0,0,0)\n"
      << "endian: little\nencoding: raw\ndata file: " << voxels << "\n";
  if (!out.flush()) throw std::runtime_error("cannot write " + header.string());
  return header.string();
}

ImplicitFunction implicit_function(const std::string& name) {
  static const std::map<std::string, ImplicitFunction> functions{
      {"torus", torus}, {"tanglecube", tanglecube}, {"gyroid", gyroid}};
  const auto found = functions.find(name);
  if (found == functions.end()) throw std::runtime_error("there is no function for " + name);
  return found->second;
}

}  // namespace scantet::bench
