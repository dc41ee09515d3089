// The surest check that a file can be written is to begin one: AtomicFile makes its temporary file and takes it away.
#include "scantet/app/outputs.h"

#include <algorithm>

#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/base/options.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/mesh_io.h"
#include "scantet/io/resolved_path.h"
#include "scantet/report/report.h"

namespace scantet {
namespace {

void check_extension(const std::string& file, const char* option, const std::vector<std::string>& known) {
  const std::string extension = file_extension(file);
  if (std::find(known.begin(), known.end(), extension) != known.end()) return;
  std::string list;
  for (const std::string& one : known) list += (list.empty() ? "" : " ") + one;
  const auto meant = closest_name(extension, known);
  throw Error(Fault::usage, "usage.format",
              std::string(option) + ": " + file + ": " +
                  (extension.empty() ? "no extension" : "unknown extension " + extension) +
                  (meant ? "; did you mean " + *meant + "?" : ""),
              "the extension chooses the format: " + list);
}

}  // namespace

void check_outputs(const std::vector<std::string>& meshes, const std::vector<std::string>& reports,
                   const std::vector<std::string>& inputs) {
  std::vector<std::string> mesh_extensions;
  for (const MeshFormat& format : mesh_formats()) {
    if (format.can_write) mesh_extensions.push_back(format.extension);
  }
  for (const std::string& file : meshes) check_extension(file, "--output", mesh_extensions);
  for (const std::string& file : reports) check_extension(file, "--report", report_extensions());

  std::vector<std::string> files = meshes;
  files.insert(files.end(), reports.begin(), reports.end());
  check_writable(files, inputs);
}

void check_writable(const std::vector<std::string>& files, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (const std::string& input : inputs) {
      if (!is_same_file(files[i], input)) continue;
      throw Error(Fault::usage, "usage.same_file", files[i] + ": this output is also read, as " + input,
                  "choose another name");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_same_file(files[i], files[j])) continue;
      throw Error(Fault::usage, "usage.same_file", files[i] + ": named twice as an output", "name it once");
    }
    const AtomicFile probe(files[i]);
  }
}

}  // namespace scantet
