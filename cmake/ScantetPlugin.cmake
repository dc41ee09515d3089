# scantet_add_plugin(NAME SOURCES file... [PRIVATE target...])
#   A plugin of scantet: the loadable module NAME.so, made by the target `plugin_NAME`. PRIVATE are libraries that it
#   needs beside scantet's. It is installed into the plugin folder, <libdir>/scantet/plugins under the prefix, where
#   scantet finds it if it has the same prefix. Works in scantet's tree and, after find_package(scantet), in others.
include(GNUInstallDirs)
function(scantet_add_plugin NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;PRIVATE" ${ARGN})
  set(target plugin_${NAME})
  add_library(${target} MODULE ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE scantet::scantet ${ARG_PRIVATE})
  # Hidden: templates that the plugin and a library both instantiate do not replace each other. Those of namespace std
  # are visible all the same, so the linker is told what to export, too.
  set(exports "${CMAKE_CURRENT_BINARY_DIR}/${target}.map")
  file(WRITE "${exports}" "{ global: scantet_plugin; local: *; };\n")
  target_link_options(${target} PRIVATE "LINKER:--version-script=${exports}")
  set_target_properties(${target} PROPERTIES PREFIX "" SUFFIX ".so" OUTPUT_NAME ${NAME} CXX_VISIBILITY_PRESET hidden
                                             VISIBILITY_INLINES_HIDDEN ON INSTALL_RPATH "$ORIGIN/../..")
  set_property(GLOBAL APPEND PROPERTY SCANTET_PLUGINS ${target})
  install(TARGETS ${target} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/scantet/plugins" COMPONENT scantet-plugins)
endfunction()
