# Finds what the Python package needs (bindings/python): an interpreter with its headers, and pybind11's headers.
find_program(SCANTET_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH DOC "Python that the package is for")
find_program(SCANTET_PYTHON NAMES python3)
find_path(SCANTET_PYBIND11_INCLUDE pybind11/pybind11.h DOC "Folder with pybind11's headers")
set(scantet_has_python OFF)
if(SCANTET_PYTHON AND SCANTET_PYBIND11_INCLUDE)
  execute_process(COMMAND "${SCANTET_PYTHON}" -c "import sysconfig; print(sysconfig.get_path('include'), end='')"
                  OUTPUT_VARIABLE folder ERROR_QUIET)
  if(EXISTS "${folder}/Python.h")
    set(scantet_has_python ON)
  endif()
endif()
if(SCANTET_SANITIZE)  # a sanitized library works in a sanitized program only, and Python is none
  set(scantet_has_python OFF)
endif()
option(SCANTET_BUILD_PYTHON "Build the Python package" ${scantet_has_python})
if(SCANTET_BUILD_PYTHON AND NOT scantet_has_python)
  message(FATAL_ERROR "SCANTET_BUILD_PYTHON: needs python3-dev and pybind11-dev, and no sanitizer")
endif()
