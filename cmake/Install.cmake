# Installs the library, its public headers, the program, the package that find_package(scantet) finds, and the documents.
include(CMakePackageConfigHelpers)
set(scantet_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/scantet")
set(scantet_contract_dir "${CMAKE_INSTALL_DATADIR}/scantet/contract")

install(TARGETS scantet_library EXPORT scantet-targets LIBRARY COMPONENT libscantet NAMELINK_COMPONENT libscantet-dev
        FILE_SET HEADERS COMPONENT libscantet-dev)
if(TARGET scantet)
  install(TARGETS scantet scantet_checker RUNTIME COMPONENT scantet)
endif()
if(SCANTET_BUILD_VTK)
  export(EXPORT scantet-targets NAMESPACE scantet::)  # its targets are exported for the build tree, too, and need ours
endif()
install(EXPORT scantet-targets NAMESPACE scantet:: FILE scantet-targets.cmake DESTINATION "${scantet_package_dir}" COMPONENT libscantet-dev)

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/scantetConfig.cmake.in" scantetConfig.cmake
                              INSTALL_DESTINATION "${scantet_package_dir}" PATH_VARS scantet_contract_dir)
write_basic_package_version_file(scantetConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/scantetConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/scantetConfigVersion.cmake"
              "${CMAKE_CURRENT_LIST_DIR}/ScantetPlugin.cmake"
        DESTINATION "${scantet_package_dir}" COMPONENT libscantet-dev)

install(FILES "${PROJECT_SOURCE_DIR}/tests/contract/domain_contract.h"
              "${PROJECT_SOURCE_DIR}/tests/contract/domain_contract.cpp"
              "${PROJECT_SOURCE_DIR}/tests/contract/plugin_case.h"
        DESTINATION "${scantet_contract_dir}" COMPONENT libscantet-dev)

install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${PROJECT_SOURCE_DIR}/SECURITY.md"
              "${PROJECT_SOURCE_DIR}/CONTRIBUTING.md" "${PROJECT_SOURCE_DIR}/CITATION.cff" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT scantet-doc)
if(NOT SCANTET_DEBIAN_FILES)  # a Debian package has its licence in its copyright file
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT scantet-doc)
endif()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/src/scantet/decks/templates/" DESTINATION "${CMAKE_INSTALL_DATADIR}/scantet/decks" COMPONENT scantet)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT scantet-doc)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/bindings/vtk" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT scantet-doc)  # built with the user's VTK
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT scantet-doc FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg" PATTERN "*.json" PATTERN "*.txt")
