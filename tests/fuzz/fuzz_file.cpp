// One file of bytes through the reader for its extension. libFuzzer makes the bytes; an Error is what a damaged file is
// expected to end in, and anything else that ends the run is a fault. Compiled once a kind: SCANTET_FUZZ_EXTENSION
// chooses the reader. Text headers have no target that forks: their checks are called by themselves.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "scantet/app/config.h"
#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/io/mesh_io.h"
#include "scantet/plugin/plugin_loader.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/reading/text_header_impl.h"

namespace {

using namespace scantet;

const std::string& path() {
  static const std::string file = "/tmp/scantet_fuzz_" + std::to_string(getpid()) + SCANTET_FUZZ_EXTENSION;
  return file;
}

const PluginRegistry& plugins() {
  static const PluginRegistry all = [] {
    PluginRegistry registry;
    load_plugin_folder(plugin_folder(), registry);
    return registry;
  }();
  return all;
}

bool is_mesh(const std::string& extension) {
  for (const MeshFormat& format : mesh_formats()) {
    if (format.can_read && format.extension == extension) return true;
  }
  return false;
}

void read_one() {
  const std::string extension = file_extension(path());
  Progress progress;
  if (is_mesh(extension)) {
    read_mesh(path());
  } else if (extension == ".json") {
    read_config(path());
  } else if (extension == ".nii") {
    read_scan(path(), progress);
  } else if (extension == ".nrrd" || extension == ".mha") {
    check_text_header(path());
  } else {
    plugins().create_for(path())->info(path(), progress);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  std::ofstream(path(), std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  try {
    read_one();
  } catch (const scantet::Error&) {
    return 0;
  }
  return 0;
}
