# The target `doxygen`: the reference of the public headers, as web pages in <build>/doxygen/html. Not part of `all`;
# `ctest -R docs.reference` makes it, too.
find_program(DOXYGEN_PROGRAM doxygen)
set(scantet_doxygen_command "")
if(DOXYGEN_PROGRAM)
  set(SCANTET_DOXYGEN_OUTPUT "${PROJECT_BINARY_DIR}/doxygen")
  list(JOIN scantet_headers "\" \"" SCANTET_DOXYGEN_INPUT)
  set(SCANTET_DOXYGEN_INPUT "\"${SCANTET_DOXYGEN_INPUT}\" \"${PROJECT_BINARY_DIR}/src/scantet/base/version.h\"")
  configure_file("${PROJECT_SOURCE_DIR}/docs/Doxyfile" "${SCANTET_DOXYGEN_OUTPUT}/Doxyfile" @ONLY)
  set(scantet_doxygen_command "${CMAKE_COMMAND}" "-DPROGRAM=${DOXYGEN_PROGRAM}" "-DFILE=${SCANTET_DOXYGEN_OUTPUT}/Doxyfile" -P
                              "${PROJECT_SOURCE_DIR}/cmake/RunDoxygen.cmake")
  add_custom_target(doxygen COMMAND ${scantet_doxygen_command} COMMENT "The reference of the public headers" VERBATIM)
endif()
