# find_package(vtkScantet) defines the target Scantet, the module of VTK with vtkScantetMesher and vtkTetQualityHistogram.
include(CMakeFindDependencyMacro)
find_dependency(scantet)
find_dependency(VTK 9.1 COMPONENTS CommonCore CommonDataModel CommonExecutionModel)
include("${CMAKE_CURRENT_LIST_DIR}/vtkScantet-targets.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/vtkScantet-vtk-module-properties.cmake")
