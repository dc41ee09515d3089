// The known formats are those of the modules that write them.
#include "scantet/app/outputs.h"

#include <algorithm>

#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/base/options.h"
#include "scantet/io/mesh_io.h"
#include "scantet/io/writable.h"
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
                   const std::vector<std::string>& inputs, const std::vector<std::string>& beside) {
  std::vector<std::string> mesh_extensions;
  for (const MeshFormat& format : mesh_formats()) {
    if (format.can_write) mesh_extensions.push_back(format.extension);
  }
  for (const std::string& file : meshes) check_extension(file, "--output", mesh_extensions);
  for (const std::string& file : reports) check_extension(file, "--report", report_extensions());

  std::vector<std::string> files;
  for (const std::string& mesh : meshes) {
    for (const std::string& file : mesh_files(mesh)) files.push_back(file);
  }
  files.insert(files.end(), reports.begin(), reports.end());
  files.insert(files.end(), beside.begin(), beside.end());
  check_writable(files, inputs);
}

}  // namespace scantet
