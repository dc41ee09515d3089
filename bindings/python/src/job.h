// The command's jobs, called from Python.
#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <string>
#include <vector>

#include "scantet/app/job_result.h"
#include "scantet/base/options.h"
#include "scantet/field/scan.h"

namespace scantet::python {

/// What a job is of, and how: as the command takes it.
struct Call {
  std::string input;                  ///< a path, or the name of what is in memory
  std::vector<OptionValue> values;    ///< as typed
  std::vector<std::string> plugins;   ///< files of further plugins
  std::map<std::string, Scan> scans;  ///< in memory, by the names that stand for them
  pybind11::object domain;            ///< a scantet.Domain, or None
  pybind11::object progress;          ///< as run_watched() takes it
};

/// Every option of `scantet mesh`: its declaration as a dict. plugins: files of further ones.
pybind11::list mesh_options(const std::vector<std::string>& plugins);

/// Every option of `scantet verify`, likewise.
pybind11::list verify_options();

/// `scantet mesh`. Throws Error as run_mesh_job(); what Python code raised.
JobResult run_mesh(const Call& call);

/// `scantet info --json`.
std::string run_info(const Call& call);

/// `scantet verify` of a mesh file: (grade, whether that is as required, text for people).
pybind11::tuple run_verification(const std::string& mesh, const std::vector<OptionValue>& values,
                                 const pybind11::object& progress);

}  // namespace scantet::python
