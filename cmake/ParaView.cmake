# The plugin of ParaView: a Python file that calls the program (docs/vtk.md).
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_BINDIR BASE_DIRECTORY "${CMAKE_INSTALL_FULL_LIBDIR}/scantet/paraview"
           OUTPUT_VARIABLE scantet_from_paraview)
configure_file("${PROJECT_SOURCE_DIR}/bindings/paraview/ScantetParaView.py.in" "${PROJECT_BINARY_DIR}/paraview/ScantetParaView.py" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/paraview/ScantetParaView.py" DESTINATION "${CMAKE_INSTALL_LIBDIR}/scantet/paraview"
        COMPONENT scantet)
