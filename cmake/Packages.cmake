# Debian packages, one a component: `cmake --build --preset packages && cpack --config build/packages/CPackConfig.cmake`,
# which scripts/package_test.sh does and tries the packages out. Included last, when all components are known.
set(scantet_libscantet_name "libscantet${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")  # as its soname
set(same "(= ${PROJECT_VERSION}-1)")
set(needs_library "${scantet_libscantet_name} ${same}")

# scantet_package(COMPONENT SECTION DEPENDS SUMMARY LONG): a component's package; dependencies on what it links are found.
macro(scantet_package COMPONENT SECTION DEPENDS SUMMARY LONG)
  string(TOUPPER "${COMPONENT}" upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME "${COMPONENT}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION "${SECTION}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${DEPENDS}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${SUMMARY}\n${LONG}")
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${SUMMARY}\n${LONG}")
endmacro()

scantet_package(scantet science "${needs_library}" "tetrahedral meshes from medical scans"
  "Turns a NRRD, NIfTI, MetaImage, DICOM or TIFF volume into a tetrahedral\nmesh that a solver accepts, and checks it against the scan. Also a module of\n3D Slicer.")
set(CPACK_DEBIAN_SCANTET_PACKAGE_RECOMMENDS "scantet-plugins ${same}")
set(CPACK_DEBIAN_SCANTET_PACKAGE_SUGGESTS "scantet-doc")
scantet_package(libscantet libs "" "tetrahedral meshes from medical scans - library"
  "What the program scantet does, for other programs.")
set(CPACK_DEBIAN_LIBSCANTET_PACKAGE_NAME "${scantet_libscantet_name}")
# What others that link the library depend on, and that the linker's cache is brought up to date.
file(WRITE "${PROJECT_BINARY_DIR}/control/shlibs"
     "libscantet ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} ${needs_library}\n")
file(WRITE "${PROJECT_BINARY_DIR}/control/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBSCANTET_PACKAGE_CONTROL_EXTRA "${PROJECT_BINARY_DIR}/control/shlibs" "${PROJECT_BINARY_DIR}/control/triggers")
scantet_package(libscantet-dev libdevel "${needs_library}" "tetrahedral meshes from medical scans - headers"
  "Headers and the CMake package of the library scantet, and what plugins are\ntested with.")
scantet_package(libscantet-vtk-dev libdevel "libscantet-dev ${same}, libvtk9-dev, python3" "tetrahedral meshes from medical scans - filters for VTK"
  "The filters vtkScantetMesher and vtkTetQualityHistogram, a module of VTK for\nprograms in C++ and Python.")
set(CPACK_DEBIAN_LIBSCANTET-VTK-DEV_PACKAGE_CONTROL_EXTRA "${PROJECT_BINARY_DIR}/control/triggers")
scantet_package(scantet-plugins science "${needs_library}" "tetrahedral meshes from medical scans - further inputs"
  "Plugins of scantet: formulas, surfaces, points and OpenVDB grids.")
scantet_package(scantet-doc doc "" "tetrahedral meshes from medical scans - documents"
  "Guides, options, formats, benchmarks and examples of scantet.")
set(CPACK_DEBIAN_SCANTET-DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_SCANTET-DOC_PACKAGE_SHLIBDEPS OFF)
scantet_package(python3-scantet python "${needs_library}, python3, python3-numpy" "tetrahedral meshes from medical scans - Python"
  "The Python package scantet: meshes of files and of NumPy arrays.")
set(CPACK_DEBIAN_PYTHON3-SCANTET_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/debian/python3-scantet/prerm")
scantet_package(scantet-cohort science "scantet ${same}, python3, python3-numpy, snakemake" "tetrahedral meshes from medical scans - cohorts"
  "Meshes whole BIDS folders with Snakemake, on one machine or a cluster.")
set(CPACK_DEBIAN_SCANTET-COHORT_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_SCANTET-COHORT_PACKAGE_SHLIBDEPS OFF)

# Those that there are in this build.
get_cmake_property(components COMPONENTS)
set(CPACK_COMPONENTS_ALL)
foreach(component scantet libscantet libscantet-dev libscantet-vtk-dev scantet-plugins scantet-doc python3-scantet scantet-cohort)
  if(component IN_LIST components)
    list(APPEND CPACK_COMPONENTS_ALL ${component})
  endif()
endforeach()

if(SCANTET_DEBIAN_FILES)
  configure_file("${CMAKE_CURRENT_LIST_DIR}/debian/changelog.in" changelog.Debian @ONLY)
  execute_process(COMMAND gzip --best --no-name --force --keep changelog.Debian WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}"
                  COMMAND_ERROR_IS_FATAL ANY)
  foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    string(TOUPPER "${component}" upper)
    set(name "${CPACK_DEBIAN_${upper}_PACKAGE_NAME}")
    install(FILES "${CMAKE_CURRENT_LIST_DIR}/debian/copyright" "${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian.gz"
            DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${name}" COMPONENT ${component})
    if(EXISTS "${CMAKE_CURRENT_LIST_DIR}/debian/${component}.lintian-overrides")
      install(FILES "${CMAKE_CURRENT_LIST_DIR}/debian/${component}.lintian-overrides"
              DESTINATION "${CMAKE_INSTALL_DATADIR}/lintian/overrides" RENAME "${name}" COMPONENT ${component})
    endif()
  endforeach()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME scantet)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_CONTACT "The scantet developers <scantet@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/lib")
include(CPack)
