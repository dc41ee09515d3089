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

using Texts = std::vector<std::string>;

bool is_one_of(const std::string& text, const Texts& texts) {
  return std::find(texts.begin(), texts.end(), text) != texts.end();
}

/// other: extensions of what goes elsewhere; what that is, and where.
void check_extension(const std::string& file, const std::string& option, const Texts& known, const Texts& other,
                     const std::string& what, const std::string& elsewhere) {
  const std::string extension = file_extension(file);
  if (is_one_of(extension, known)) return;
  const std::string place = (option.empty() ? "" : option + ": ") + file + ": ";
  if (is_one_of(extension, other)) {
    throw Error(Fault::usage, "usage.format", place + extension + " is a format of " + what, elsewhere);
  }
  std::string list;
  for (const std::string& one : known) list += (list.empty() ? "" : " ") + one;
  const auto meant = closest_name(extension, known);
  throw Error(Fault::usage, "usage.format",
              place + (extension.empty() ? "no extension" : "unknown extension " + extension) +
                  (meant ? "; did you mean " + *meant + "?" : ""),
              "the extension chooses the format: " + list);
}

}  // namespace

void check_outputs(const std::vector<std::string>& meshes, const std::vector<std::string>& reports,
                   const std::vector<std::string>& inputs, const std::vector<std::string>& beside,
                   const std::string& mesh_option) {
  std::vector<std::string> mesh_extensions;
  for (const MeshFormat& format : mesh_formats()) {
    if (format.can_write) mesh_extensions.push_back(format.extension);
  }
  for (const std::string& file : meshes) {
    const std::string command = mesh_option.empty() ? "scantet report MESH " : "give ";
    check_extension(file, mesh_option, mesh_extensions, report_extensions(), "reports, not of meshes",
                    command + "--report " + file);
  }
  for (const std::string& file : reports) {
    check_extension(file, "--report", report_extensions(), mesh_extensions, "meshes, not of reports",
                    "scantet mesh writes meshes: --output " + file);
  }

  std::vector<std::string> files;
  for (const std::string& mesh : meshes) {
    for (const std::string& file : mesh_files(mesh)) files.push_back(file);
  }
  files.insert(files.end(), reports.begin(), reports.end());
  files.insert(files.end(), beside.begin(), beside.end());
  check_writable(files, inputs);
}

}  // namespace scantet
