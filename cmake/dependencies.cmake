# Every library from outside, by its own CMake package or by pkg-config. Keep packages.txt in step.
include(${CMAKE_CURRENT_LIST_DIR}/find_dependencies.cmake)

if(STRAINWAVE_TESTS)
  find_package(GTest REQUIRED)
endif()
if(STRAINWAVE_BENCH)
  find_package(benchmark REQUIRED)
endif()
