# Finds OpenVDB (Debian: libopenvdb-dev) and makes the target OpenVDB::openvdb. OpenVDB's own module lies outside of CMake's
# path and brings find modules for TBB and others that would shadow CMake's.
find_path(OpenVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(OpenVDB_LIBRARY openvdb)
find_package(TBB QUIET)
find_package(Imath CONFIG QUIET)  # half floats
if(OpenVDB_INCLUDE_DIR)
  file(STRINGS "${OpenVDB_INCLUDE_DIR}/openvdb/version.h" OpenVDB_VERSION REGEX "define OPENVDB_LIBRARY_MAJOR_VERSION_NUMBER")
  string(REGEX MATCH "[0-9]+" OpenVDB_VERSION "${OpenVDB_VERSION}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenVDB REQUIRED_VARS OpenVDB_LIBRARY OpenVDB_INCLUDE_DIR TBB_FOUND Imath_FOUND
                                  VERSION_VAR OpenVDB_VERSION)
if(OpenVDB_FOUND AND NOT TARGET OpenVDB::openvdb)
  add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
  set_target_properties(OpenVDB::openvdb PROPERTIES IMPORTED_LOCATION "${OpenVDB_LIBRARY}"
                                                    INTERFACE_INCLUDE_DIRECTORIES "${OpenVDB_INCLUDE_DIR}"
                                                    INTERFACE_LINK_LIBRARIES "TBB::tbb;Imath::Imath")
endif()
mark_as_advanced(OpenVDB_INCLUDE_DIR OpenVDB_LIBRARY)
