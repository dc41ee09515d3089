# The command-line module of 3D Slicer: a script that calls the program, in a folder that Slicer is told of.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_BINDIR BASE_DIRECTORY "${CMAKE_INSTALL_FULL_LIBDIR}/scantet/slicer"
           OUTPUT_VARIABLE scantet_from_slicer)
configure_file("${CMAKE_CURRENT_LIST_DIR}/slicer_module.in" "${PROJECT_BINARY_DIR}/slicer/ScantetMesh" @ONLY)
install(PROGRAMS "${PROJECT_BINARY_DIR}/slicer/ScantetMesh" DESTINATION "${CMAKE_INSTALL_LIBDIR}/scantet/slicer"
        COMPONENT scantet)
