# scantet_module(NAME SOURCES file... [NEEDS module...] [PRIVATE third_party_target...])
#   One folder of src/scantet/ as an object library `scantet_NAME`. NEEDS are the modules its headers may include (the
#   arrows of docs/architecture.md); PRIVATE third parties never reach another module's include path.
#
# scantet_test(NAME SOURCES file... NEEDS module... [LABEL label] [PRIVATE target...])
#   A GoogleTest program of the objects of exactly those modules, its cases registered with CTest under LABEL.
function(scantet_module NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;NEEDS;PRIVATE" ${ARGN})
  set(target scantet_${NAME})
  add_library(${target} OBJECT ${ARG_SOURCES})
  target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}/src" "${PROJECT_BINARY_DIR}/src")
  target_link_libraries(${target} PRIVATE scantet_options ${ARG_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY SCANTET_MODULES ${target})
  set_property(GLOBAL PROPERTY SCANTET_PRIVATE_${NAME} "${ARG_PRIVATE}")
endfunction()

function(scantet_test NAME)
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;NEEDS;PRIVATE" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  add_executable(${NAME} ${ARG_SOURCES})
  target_include_directories(${NAME} PRIVATE "${PROJECT_SOURCE_DIR}/src" "${PROJECT_BINARY_DIR}/src"
                                             "${PROJECT_SOURCE_DIR}/tests")
  target_link_libraries(${NAME} PRIVATE scantet_options GTest::gtest_main ${ARG_PRIVATE})
  foreach(module IN LISTS ARG_NEEDS)
    get_property(third_party GLOBAL PROPERTY SCANTET_PRIVATE_${module})
    target_link_libraries(${NAME} PRIVATE scantet_${module} ${third_party})
  endforeach()
  gtest_discover_tests(${NAME} PROPERTIES LABELS ${ARG_LABEL} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60)
endfunction()
