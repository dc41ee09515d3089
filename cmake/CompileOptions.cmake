# Language level, warnings and sanitizers, for every target of the project.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

add_library(scantet_options INTERFACE)
# No contraction of a*b+c: the same bytes on every x86-64 and ARM compiler.
target_compile_options(scantet_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wno-unknown-warning-option
                                                 -ffp-contract=off)
if(SCANTET_SANITIZE)
  target_compile_options(scantet_options INTERFACE -fsanitize=${SCANTET_SANITIZE} -fno-omit-frame-pointer -g)
  target_link_options(scantet_options INTERFACE -fsanitize=${SCANTET_SANITIZE})
endif()
