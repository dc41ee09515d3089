#include "backend.h"

#include <dlfcn.h>

#include <filesystem>

#include "scantet/base/error.h"

namespace vdb {
namespace {

const Backend& load_backend() {
  Dl_info info;
  const bool known = dladdr(reinterpret_cast<const void*>(&load_backend), &info) != 0 && info.dli_fname != nullptr;
  const std::filesystem::path self = known ? info.dli_fname : "";
  const std::string file = (self.parent_path() / "vdb" / "openvdb.so").string();
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  const void* symbol = library == nullptr ? nullptr : dlsym(library, kBackendSymbol);
  if (symbol != nullptr) return *static_cast<const Backend*>(symbol);
  throw scantet::Error(scantet::Fault::usage, "usage.plugin",
                       "plugin vdb: its library " + file + " cannot be loaded: " + dlerror(),
                       "install OpenVDB, or build the plugin anew");
}

}  // namespace

const Backend& backend() {
  static const Backend& loaded = load_backend();
  return loaded;
}

}  // namespace vdb
