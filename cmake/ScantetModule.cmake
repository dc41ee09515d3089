# scantet_module(NAME SOURCES file... [NEEDS module...] [PRIVATE third_party_target...])
#   One folder of src/scantet/ as an object library `scantet_NAME`. NEEDS are the modules its headers may include (the
#   arrows of docs/architecture.md); PRIVATE third parties never reach another module's include path.
#
# scantet_test(NAME SOURCES file... NEEDS module... [LABEL label] [THREADED] [PRIVATE target...])
#   A GoogleTest program of the objects of those modules and of all that they need, its cases registered with CTest under
#   LABEL (default unit). THREADED: they run loops on several threads, for ThreadSanitizer; `ctest -L threads` selects them.
#   With SCANTET_JOIN_TESTS eight files are compiled at once: they take longer to read headers than for all the rest.
#   The targets unit_tests, guarantee_tests, threaded_tests … build all programs of a label, or all that are THREADED.
function(scantet_module NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;NEEDS;PRIVATE" ${ARGN})
  set(target scantet_${NAME})
  add_library(${target} OBJECT ${ARG_SOURCES})
  target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}/src" "${PROJECT_BINARY_DIR}/src")
  target_link_libraries(${target} PRIVATE scantet_options ${ARG_PRIVATE})
  # base/api.h. Clang gives functions that are defined outside of a namespace's marked opening none of its visibility, so
  # with Clang only scantet.map hides anything.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endif()
  set_property(GLOBAL APPEND PROPERTY SCANTET_MODULES ${target})
  set_property(GLOBAL PROPERTY SCANTET_PRIVATE_${NAME} "${ARG_PRIVATE}")
  set(all ${NAME})  # with what it needs, and what these need; modules are declared in the order of the arrows
  foreach(need IN LISTS ARG_NEEDS)
    get_property(more GLOBAL PROPERTY SCANTET_ALL_${need})
    if(NOT more)
      message(FATAL_ERROR "module ${NAME} needs ${need}, which is not declared before it")
    endif()
    list(APPEND all ${more})
  endforeach()
  list(REMOVE_DUPLICATES all)
  set_property(GLOBAL PROPERTY SCANTET_ALL_${NAME} "${all}")
endfunction()

function(scantet_test NAME)
  cmake_parse_arguments(ARG "THREADED" "LABEL" "SOURCES;NEEDS;PRIVATE" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  add_executable(${NAME} ${ARG_SOURCES})
  set_target_properties(${NAME} PROPERTIES UNITY_BUILD ${SCANTET_JOIN_TESTS} UNITY_BUILD_BATCH_SIZE 8)
  set(groups ${ARG_LABEL}_tests)
  if(ARG_THREADED)
    list(APPEND groups threaded_tests)
    string(APPEND ARG_LABEL "+threads")  # one label: gtest_discover_tests loses all but the first of several
  endif()
  foreach(group IN LISTS groups)
    if(NOT TARGET ${group})
      add_custom_target(${group})
    endif()
    add_dependencies(${group} ${NAME})
  endforeach()
  target_include_directories(${NAME} PRIVATE "${PROJECT_SOURCE_DIR}/src" "${PROJECT_BINARY_DIR}/src"
                                             "${PROJECT_SOURCE_DIR}/tests")
  target_link_libraries(${NAME} PRIVATE scantet_options GTest::gtest_main ${ARG_PRIVATE})
  target_compile_options(${NAME} PRIVATE "$<$<CONFIG:Release>:-O1>")  # tests take longer to compile than to run
  set(all)
  foreach(module IN LISTS ARG_NEEDS)
    get_property(more GLOBAL PROPERTY SCANTET_ALL_${module})
    list(APPEND all ${more})
  endforeach()
  list(REMOVE_DUPLICATES all)
  foreach(module IN LISTS all)
    get_property(third_party GLOBAL PROPERTY SCANTET_PRIVATE_${module})
    target_link_libraries(${NAME} PRIVATE scantet_${module} ${third_party})
  endforeach()
  gtest_discover_tests(${NAME} PROPERTIES LABELS ${ARG_LABEL} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60)
endfunction()
