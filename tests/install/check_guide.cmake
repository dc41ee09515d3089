# The guide's example is the plugin that the tests build: each of its files stands in the guide, line for line.
file(READ "${GUIDE}" guide)
foreach(name CMakeLists.txt ellipsoid.cpp ellipsoid_contract.cpp)
  file(READ "${SOURCE}/${name}" text)
  string(FIND "${guide}" "${text}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "${GUIDE} does not show ${SOURCE}/${name} as it is; copy the file into it")
  endif()
endforeach()
