# Half of a build is the reading of the same few headers. They are read once: for the rooms, for the rooms that speak JSON,
# and for the tests. Sources include what they use all the same: STRAINWAVE_PRECOMPILED=OFF builds without, and nightly does.
option(STRAINWAVE_PRECOMPILED "precompiled headers" ON)

set(strainwave_precompiled_headers
  <algorithm> <array> <cmath> <functional> <limits> <map> <memory> <numbers> <optional> <span> <stdexcept> <string>
  <string_view> <utility> <variant> <vector> <Eigen/Dense> <fmt/format.h>)
set(strainwave_precompiled_libraries Eigen3::Eigen fmt::fmt Boost::headers nlohmann_json::nlohmann_json)

# A library that exists for its precompiled header: flags and definitions are those of every target that takes it.
function(strainwave_precompiled name)
  cmake_parse_arguments(P "" "" "HEADERS;LIBRARIES" ${ARGN})
  if(NOT STRAINWAVE_PRECOMPILED)
    return()
  endif()
  set(source ${PROJECT_BINARY_DIR}/${name}.cpp)
  file(WRITE ${source}.in "// Carries a precompiled header.\n")
  configure_file(${source}.in ${source} COPYONLY)
  add_library(${name} OBJECT ${source})
  target_link_libraries(${name} PRIVATE strainwave_options strainwave_build ${strainwave_precompiled_libraries} ${P_LIBRARIES})
  target_precompile_headers(${name} PRIVATE ${strainwave_precompiled_headers} ${P_HEADERS})
endfunction()

function(strainwave_take_precompiled target from)
  if(STRAINWAVE_PRECOMPILED)
    foreach(library ${strainwave_precompiled_libraries})
      target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:${library}>)
    endforeach()
    target_precompile_headers(${target} REUSE_FROM ${from})
  endif()
endfunction()

strainwave_precompiled(strainwave_precompiled_room)
strainwave_precompiled(strainwave_precompiled_json HEADERS <nlohmann/json.hpp>)
if(STRAINWAVE_PRECOMPILED)
  set_target_properties(strainwave_precompiled_room strainwave_precompiled_json PROPERTIES POSITION_INDEPENDENT_CODE ON)
endif()
# Not position-independent: the program and the tests.
strainwave_precompiled(strainwave_precompiled_program HEADERS <nlohmann/json.hpp>)
if(STRAINWAVE_TESTS)
  strainwave_precompiled(strainwave_precompiled_test HEADERS <gtest/gtest.h> <nlohmann/json.hpp> LIBRARIES GTest::gtest)
endif()

# libraries: what the room uses from outside.
function(strainwave_precompile target)
  if(nlohmann_json::nlohmann_json IN_LIST ARGN)
    strainwave_take_precompiled(${target} strainwave_precompiled_json)
  else()
    strainwave_take_precompiled(${target} strainwave_precompiled_room)
  endif()
endfunction()

function(strainwave_precompile_test target)
  strainwave_take_precompiled(${target} strainwave_precompiled_test)
endfunction()
