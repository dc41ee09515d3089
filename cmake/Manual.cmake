# Manual pages and completions, made by the program from its options, those of its plugins among them, and installed.
# Included after the plugins.
if(SCANTET_SANITIZE OR SCANTET_BUILD_FUZZERS)
  return()  # such a program is not for installing
endif()
set(scantet_commands mesh info report verify diff convert cohort plugins)  # tests/cli/manual_test.py: all of them
set(manual_folder "${PROJECT_BINARY_DIR}/manual")
file(MAKE_DIRECTORY "${manual_folder}")
get_property(scantet_plugins GLOBAL PROPERTY SCANTET_PLUGINS)

set(man_pages)
foreach(command IN ITEMS "" ${scantet_commands})
  set(page scantet.1)
  if(command)
    set(page scantet-${command}.1)
  endif()
  add_custom_command(
    OUTPUT "${manual_folder}/${page}.gz"
    COMMAND scantet man ${command} > "${manual_folder}/${page}"
    COMMAND gzip --best --no-name --force "${manual_folder}/${page}"
    DEPENDS scantet ${scantet_plugins} VERBATIM)
  list(APPEND man_pages "${manual_folder}/${page}.gz")
endforeach()
foreach(shell bash zsh fish)
  add_custom_command(
    OUTPUT "${manual_folder}/completion.${shell}"
    COMMAND scantet completion ${shell} > "${manual_folder}/completion.${shell}"
    DEPENDS scantet ${scantet_plugins} VERBATIM)
  list(APPEND completions "${manual_folder}/completion.${shell}")
endforeach()
# The checker of certificates has no options that are declared.
configure_file("${PROJECT_SOURCE_DIR}/src/scantet/checker/scantet-check.1.in" "${manual_folder}/scantet-check.1" @ONLY)
add_custom_command(
  OUTPUT "${manual_folder}/scantet-check.1.gz"
  COMMAND gzip --best --no-name --force --keep "${manual_folder}/scantet-check.1"
  DEPENDS "${PROJECT_SOURCE_DIR}/src/scantet/checker/scantet-check.1.in" VERBATIM)
list(APPEND man_pages "${manual_folder}/scantet-check.1.gz")
add_custom_target(manual ALL DEPENDS ${man_pages} ${completions})

# Debian's zsh looks into another folder for what packages bring.
set(zsh_folder site-functions)
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(zsh_folder vendor-completions)
endif()
install(FILES ${man_pages} DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT scantet)
install(FILES "${manual_folder}/completion.bash" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
        RENAME scantet COMPONENT scantet)
install(FILES "${manual_folder}/completion.zsh" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/${zsh_folder}" RENAME _scantet
        COMPONENT scantet)
install(FILES "${manual_folder}/completion.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d"
        RENAME scantet.fish COMPONENT scantet)
