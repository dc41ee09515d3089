// Long work that Python waits for: Ctrl-C ends it, and progress is told.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "scantet/base/progress.h"

namespace scantet::python {

/// Does the work on a thread of its own, and waits for it without the GIL. About 20 times a second the calling thread
/// takes the GIL, looks for signals, and tells the listener what is new: a Python function of (stage, doing, done,
/// total or None, pending), or None. If a signal's handler or the listener raises, the work is cancelled, and once it
/// has ended that exception is thrown. Otherwise throws what the work throws.
void run_watched(const pybind11::object& listener, const std::function<void(Progress&)>& work);

}  // namespace scantet::python
