// The module _scantet: what the Python files of the package scantet call. Names and checks that Python can do are
// there.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "arrays.h"
#include "job.h"
#include "scantet/app/info.h"
#include "scantet/app/mesh_tools.h"
#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/base/version.h"
#include "scantet/io/mesh_io.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/report/report_forms.h"
#include "watched_run.h"

namespace scantet::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

/// A mesh with all that is known of it; arrays point into it.
struct Result {
  JobResult job;
};

/// (name, text) as typed.
std::vector<OptionValue> values_of(const std::vector<std::pair<std::string, std::string>>& typed) {
  std::vector<OptionValue> values;
  values.reserve(typed.size());
  for (const auto& [name, value] : typed) values.push_back({name, value, "--" + name});
  return values;
}

py::list texts(const std::vector<std::string>& lines) {
  py::list all;
  for (const std::string& line : lines) all.append(text(line));
  return all;
}

bool is_report(const std::string& path) {
  const std::string extension = file_extension(path);
  for (const std::string& known : report_extensions()) {
    if (known == extension) return true;
  }
  return false;
}

void save(const Result& result, const std::string& path, bool ras, const std::string& gmsh_version) {
  const py::gil_scoped_release released;
  if (is_report(path)) {
    write_report({&result.job.report, 1}, {&result.job.mesh, 1}, path);
  } else {
    MeshWriteOptions how;
    how.ras = ras;
    how.provenance = result.job.provenance;
    how.gmsh_version = gmsh_version;
    write_mesh(result.job.mesh, path, how);
  }
}

std::unique_ptr<Result> read_result(const std::string& path, const py::object& progress) {
  auto result = std::make_unique<Result>();
  run_watched(progress, [&](Progress& watched) {
    result->job.mesh = read_mesh(path);
    MeshFindings found = report_on_meshes({path}, {}, watched);
    if (found.cancelled) return;
    result->job.report = std::move(found.reports.front());
    result->job.findings = std::move(found.findings);
    result->job.provenance = read_provenance(path);
  });
  return result;
}

Scan read(const std::string& path, const py::object& progress) {
  Scan scan;
  run_watched(progress, [&](Progress& watched) { scan = read_scan(path, watched); });
  return scan;
}

/// (3, 4): index to LPS, mm.
py::array_t<double> frame_of(const Scan& scan) {
  py::array_t<double> frame({3, 4});
  auto at = frame.mutable_unchecked<2>();
  for (int row = 0; row < 3; ++row) {
    for (int axis = 0; axis < 3; ++axis) at(row, axis) = scan.frame.column(axis)[row];
    at(row, 3) = scan.frame.origin()[row];
  }
  return frame;
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const Error& error) {
    const py::object exception = py::module_::import("scantet._errors")
                                     .attr("error_of")(static_cast<int>(error.fault()), text(error.code()),
                                                       text(error.what()), text(error.remedy()));
    PyErr_SetObject(py::type::handle_of(exception).ptr(), exception.ptr());
  }
}

void define_scan(py::module_& module) {
  py::class_<Scan>(module, "Scan")
      .def_property_readonly("_frame", &frame_of)
      .def_property_readonly("values",
                             [](const py::object& self) { return voxel_array(self.cast<const Scan&>(), self); })
      .def_property_readonly("shape",
                             [](const Scan& scan) { return py::make_tuple(scan.size[0], scan.size[1], scan.size[2]); })
      .def_property_readonly("pixel_type", [](const Scan& scan) { return text(scan.pixel_type); })
      .def_property_readonly("format", [](const Scan& scan) { return text(scan.format); })
      .def_property_readonly("min", [](const Scan& scan) { return scan.min_value; })
      .def_property_readonly("max", [](const Scan& scan) { return scan.max_value; });
  module.def("scan_from_array", &scan_from_array, "values"_a, "frame"_a, "format"_a, "keeper"_a = py::none());
  module.def("read_scan", &read, "path"_a, "progress"_a = py::none());
}

void define_result(py::module_& module) {
  py::class_<Result>(module, "Result")
      .def("arrays", [](const py::object& self) { return mesh_arrays(self.cast<const Result&>().job.mesh, self); })
      .def_property_readonly("cancelled", [](const Result& result) { return result.job.cancelled; })
      .def_property_readonly("report_json", [](const Result& result) { return json_report(result.job.report); })
      .def_property_readonly("report_text", [](const Result& result) { return text(text_report(result.job.report)); })
      .def_property_readonly("plan_json", [](const Result& result) { return info_json(result.job.plan); })
      .def_property_readonly("is_plan", [](const Result& result) { return !result.job.plan.empty(); })
      .def_property_readonly("notes", [](const Result& result) { return texts(result.job.notes); })
      .def_property_readonly("findings", [](const Result& result) { return texts(result.job.findings); })
      .def_property_readonly("written", [](const Result& result) { return texts(result.job.written); })
      .def("save", &save, "path"_a, "ras"_a, "gmsh_version"_a);
  module.def("read_mesh", &read_result, "path"_a, "progress"_a = py::none());
}

}  // namespace

PYBIND11_MODULE(_scantet, module) {
  module.doc() = "What the package scantet calls of the library.";
  module.attr("version") = kVersion;
  py::register_exception_translator(&translate);
  define_scan(module);
  define_result(module);
  module.def("mesh_options", &mesh_options, "plugins"_a = std::vector<std::string>());
  module.def("verify_options", &verify_options);
  module.def("closest_name",
             [](const std::string& name, const std::vector<std::string>& names) { return closest_name(name, names); });
  using Typed = std::vector<std::pair<std::string, std::string>>;
  module.def(
      "mesh",
      [](const std::string& input, const Typed& typed, const std::vector<std::string>& plugins,
         const std::map<std::string, Scan>& scans, const py::object& domain, const py::object& progress) {
        return std::make_unique<Result>(Result{run_mesh({input, values_of(typed), plugins, scans, domain, progress})});
      },
      "input"_a, "typed"_a, "plugins"_a, "scans"_a, "domain"_a = py::none(), "progress"_a = py::none());
  module.def(
      "info",
      [](const std::string& input, const Typed& typed, const std::vector<std::string>& plugins,
         const std::map<std::string, Scan>& scans, const py::object& progress) {
        return py::bytes(run_info({input, values_of(typed), plugins, scans, py::none(), progress}));
      },
      "input"_a, "typed"_a, "plugins"_a, "scans"_a, "progress"_a = py::none());
  module.def(
      "verify",
      [](const std::string& mesh, const Typed& typed, const py::object& progress) {
        return run_verification(mesh, values_of(typed), progress);
      },
      "mesh"_a, "typed"_a, "progress"_a = py::none());
}

}  // namespace scantet::python
