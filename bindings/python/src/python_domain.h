// A domain whose questions a Python object answers.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <memory>
#include <mutex>

#include "scantet/plugin/plugin_registry.h"

namespace scantet::python {

/// The first exception that Python code raised while the mesher asked it.
class PythonFailure {
 public:
  /// Keeps the exception that is handled now, unless there is one.
  void keep() {
    const std::lock_guard lock(mutex_);
    if (!kept_) kept_ = std::current_exception();
  }
  /// Throws what was kept, if anything was.
  void rethrow() const {
    if (kept_) std::rethrow_exception(kept_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr kept_;
};

/// The name that stands for the domain as an input.
inline constexpr const char* kDomainInput = "python:domain";

/// Opens kDomainInput as the domain of a scantet.Domain, an object with the attributes _bounds (six numbers),
/// _default_size, _region_names, and the methods _regions(points) and _crossings(starts, ends) of _domain.py. What
/// they raise is kept in `failure`, and becomes an Error. Call it with the GIL.
InputPluginFactory python_domain_plugin(pybind11::object domain, std::shared_ptr<PythonFailure> failure);

/// An object of Python's that others may let go without the GIL.
std::shared_ptr<pybind11::object> shared_object(pybind11::object object);

}  // namespace scantet::python
