# The library: one shared object of all modules, with its third parties linked privately, so that whoever links it needs
# none of them. Included after the modules and before the program.
include(GNUInstallDirs)

# Programs and library in one place each; once installed, the program finds the library from where it is itself.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR BASE_DIRECTORY "${CMAKE_INSTALL_FULL_BINDIR}"
           OUTPUT_VARIABLE scantet_lib_from_bin)
set(CMAKE_INSTALL_RPATH "$ORIGIN/${scantet_lib_from_bin}")

include(PublicHeaders)
set(scantet_headers "${PROJECT_SOURCE_DIR}/src/scantet/scantet.h")
foreach(header IN LISTS scantet_user_headers scantet_plugin_headers scantet_adapter_headers)
  if(NOT header STREQUAL "base/version.h")  # made by CMake
    list(APPEND scantet_headers "${PROJECT_SOURCE_DIR}/src/scantet/${header}")
  endif()
endforeach()

add_library(scantet_library SHARED)
add_library(scantet::scantet ALIAS scantet_library)
set_target_properties(scantet_library PROPERTIES OUTPUT_NAME scantet EXPORT_NAME scantet VERSION ${PROJECT_VERSION}
                      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} LINKER_LANGUAGE CXX
                      INSTALL_RPATH "")
target_compile_features(scantet_library PUBLIC cxx_std_20)
target_sources(
  scantet_library
  PUBLIC FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/src" "${PROJECT_BINARY_DIR}/src"
         FILES ${scantet_headers} "${PROJECT_BINARY_DIR}/src/scantet/base/version.h")
target_link_libraries(scantet_library PRIVATE $<BUILD_INTERFACE:scantet_options>)
get_property(scantet_modules GLOBAL PROPERTY SCANTET_MODULES)
foreach(module IN LISTS scantet_modules)
  string(REGEX REPLACE "^scantet_" "" name ${module})
  get_property(third_party GLOBAL PROPERTY SCANTET_PRIVATE_${name})
  target_sources(scantet_library PRIVATE $<TARGET_OBJECTS:${module}>)
  target_link_libraries(scantet_library PRIVATE ${third_party})
endforeach()
if(NOT SCANTET_SANITIZE)  # a sanitizer's own symbols are found in the program
  set(scantet_exports "${CMAKE_CURRENT_LIST_DIR}/scantet.map")
  target_link_options(scantet_library PRIVATE -Wl,--no-undefined "LINKER:--version-script=${scantet_exports}")
  set_property(TARGET scantet_library APPEND PROPERTY LINK_DEPENDS "${scantet_exports}")
endif()
