# Every library from outside. Keep packages.txt and packages-test.txt in step.
option(STRAINWAVE_IPOPT "optimisation with Ipopt, which is under the CPL/EPL (docs/licences.md)" ON)
include(${CMAKE_CURRENT_LIST_DIR}/find_dependencies.cmake)
macro(strainwave_find_outside)
  find_package(${ARGN} REQUIRED)
endmacro()

strainwave_find(Threads::Threads Eigen3::Eigen SUNDIALS::cvodes fmt::fmt nlohmann_json::nlohmann_json Boost::headers
  NLopt::nlopt ZLIB::ZLIB CLI11::CLI11 PkgConfig::tomlplusplus PkgConfig::openblas strainwave::cholmod strainwave::hdf5)
if(STRAINWAVE_IPOPT)
  strainwave_find(PkgConfig::ipopt)
endif()
if(STRAINWAVE_TESTS)
  find_package(GTest REQUIRED)
endif()
if(STRAINWAVE_BENCH)
  find_package(benchmark REQUIRED)
endif()
