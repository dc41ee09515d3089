// A file is looked at in three steps, each with more trust: its first bytes are read; a child process loads it and asks
// for all that is asked for at the start; the same is done here. A library is never unloaded: its code may be on the
// stack of an exception or in a static object.
#include "scantet/plugin/plugin_loader.h"

#include <dlfcn.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "scantet/base/error.h"
#include "scantet/plugin/plugin.h"
#include "scantet/plugin/plugin_trial_impl.h"

namespace scantet {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& file, const std::string& what, const std::string& remedy) {
  throw Error(Fault::usage, "usage.plugin", "plugin " + file + ": " + what, remedy);
}

// dlopen would look for a name without a slash elsewhere, and takes some text files for linker scripts.
void check_file(const std::string& file) {
  std::error_code code;
  if (!fs::exists(file, code)) refuse(file, "no such file", "check the path");
  std::string start(4, '\0');
  const bool regular = fs::is_regular_file(file, code);
  if (regular) std::ifstream(file, std::ios::binary).read(start.data(), 4);
  if (!regular || start != "\177ELF") {
    refuse(file, "not a shared library", "name the .so file of a plugin");
  }
}

const PluginDescriptor& find_descriptor(const std::string& file) {
  void* library = dlopen(fs::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    refuse(file, std::string("cannot be loaded: ") + dlerror(), "build the plugin against this scantet");
  }
  const void* symbol = dlsym(library, kPluginSymbol);
  if (symbol == nullptr) {
    refuse(file, std::string("no plugin of scantet: it has no symbol ") + kPluginSymbol,
           "write SCANTET_PLUGIN(Type) in one of its sources");
  }
  const auto& descriptor = *static_cast<const PluginDescriptor*>(symbol);
  if (descriptor.interface_version != kInputPluginVersion) {
    refuse(file,
           "made for plugin interface " + std::to_string(descriptor.interface_version) + ", this is " +
               std::to_string(kInputPluginVersion) + " (scantet " + kVersion + ")",
           "build the plugin against this version");
  }
  return descriptor;
}

void rehearse(const std::string& file) {
  const PluginDescriptor* descriptor = nullptr;
  try {
    descriptor = &find_descriptor(file);
  } catch (const Error&) {
    return;  // the parent process meets the same fault, and says so
  }
  {
    const std::unique_ptr<InputPlugin> plugin(descriptor->create());
    OptionSet options;
    OptionSet convert_options;
    plugin->name();
    plugin->description();
    plugin->declare_options(options);
    plugin->declare_convert_options(convert_options);
    plugin->can_open(file);
    plugin->can_convert(file, file);
  }
  void* library = dlopen(fs::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NOLOAD);
  for (int times = 0; library != nullptr && times < 2; ++times)
    dlclose(library);  // its static objects end, as they would with the program
}

// If the plugin declared an option of the job, the job's would be set in place of the plugin's.
void check_options(const std::string& file, InputPlugin& plugin, const std::vector<std::string>& taken) {
  OptionSet of_plugin;
  plugin.declare_options(of_plugin);
  for (const Option& option : of_plugin.options()) {
    if (std::find(taken.begin(), taken.end(), option.name) == taken.end()) continue;
    refuse(file, "declares --" + option.name + ", which scantet mesh has already", "rename the option");
  }
}

bool is_loaded(const fs::path& file, const PluginRegistry& registry) {
  return std::any_of(registry.entries().begin(), registry.entries().end(), [&](const PluginEntry& entry) {
    std::error_code code;
    return !entry.file.empty() && fs::equivalent(entry.file, file, code) && !code;
  });
}

}  // namespace

void load_plugin(const std::string& file, PluginRegistry& registry) {
  check_file(file);
  const std::string trouble = try_in_child([&] { rehearse(file); });
  if (!trouble.empty()) refuse(file, "when tried in a process of its own, it " + trouble, "tell the plugin's author");
  const auto create = [make = find_descriptor(file).create] { return std::unique_ptr<InputPlugin>(make()); };
  check_options(file, *create(), registry.taken_options());
  registry.add(create, file);
}

std::vector<std::string> load_plugin_folder(const std::string& folder, PluginRegistry& registry) {
  std::vector<fs::path> files;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    if (entry->path().extension() == ".so" && !is_loaded(entry->path(), registry)) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> warnings;
  for (const fs::path& file : files) {
    try {
      load_plugin(file.string(), registry);
    } catch (const Error& error) {
      warnings.emplace_back(error.what());
    }
  }
  return warnings;
}

std::string plugin_folder() {
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&plugin_folder), &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code code;
  const fs::path library = fs::canonical(info.dli_fname, code);
  return code ? std::string() : (library.parent_path() / "scantet" / "plugins").string();
}

}  // namespace scantet
