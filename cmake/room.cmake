# A room is one folder with one concept and one library: strainwave_room(NAME SOURCES … USES … LIBRARIES … PRIVATE …).
#   USES       rooms whose headers this room's public headers or sources include
#   LIBRARIES  outside libraries seen in its public headers;  PRIVATE: only in its sources
add_library(strainwave_options INTERFACE)
target_compile_features(strainwave_options INTERFACE cxx_std_20)
target_include_directories(strainwave_options INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/strainwave>)
if(STRAINWAVE_ARCH)
  # Eigen's alignment follows the instruction set, so users of the headers need the same flag.
  target_compile_options(strainwave_options INTERFACE -march=${STRAINWAVE_ARCH})
endif()
add_library(strainwave_warnings INTERFACE)
# g++ 12's own AVX-512 header draws maybe-uninitialized (GCC bug 105593).
target_compile_options(strainwave_warnings INTERFACE -Wall -Wextra -Wshadow -Wpedantic -Wno-maybe-uninitialized
  $<$<BOOL:${STRAINWAVE_WERROR}>:-Werror>)
set_property(GLOBAL PROPERTY STRAINWAVE_ROOMS strainwave_options)

function(strainwave_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;USES;LIBRARIES;PRIVATE" ${ARGN})
  set(target strainwave_${name})
  list(TRANSFORM ROOM_USES PREPEND strainwave_)
  if(ROOM_SOURCES)
    add_library(${target} STATIC ${ROOM_SOURCES})
    target_link_libraries(${target} PUBLIC strainwave_options ${ROOM_USES} ${ROOM_LIBRARIES}
      PRIVATE ${ROOM_PRIVATE} $<BUILD_INTERFACE:strainwave_warnings>)
  else()
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE strainwave_options ${ROOM_USES} ${ROOM_LIBRARIES})
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  add_library(strainwave::${name} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY STRAINWAVE_ROOMS ${target})
endfunction()

# strainwave_test(NAME SOURCES … USES … LIBRARIES …): one test program. Tests whose suite name ends in "Nightly" run
# only under the label nightly (./run test --nightly).
function(strainwave_test name)
  cmake_parse_arguments(T "" "" "SOURCES;USES;LIBRARIES" ${ARGN})
  list(TRANSFORM T_USES PREPEND strainwave_)
  add_executable(test_${name} ${T_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${T_USES} ${T_LIBRARIES} strainwave_warnings GTest::gtest GTest::gtest_main)
  target_compile_definitions(test_${name} PRIVATE
    STRAINWAVE_TEST_REFERENCE="${PROJECT_SOURCE_DIR}/tests/reference" STRAINWAVE_SOURCE="${PROJECT_SOURCE_DIR}")
  add_test(NAME ${name} COMMAND test_${name} --gtest_filter=-*Nightly.*)
  add_test(NAME ${name}.nightly COMMAND test_${name} --gtest_filter=*Nightly.*)
  set_tests_properties(${name}.nightly PROPERTIES LABELS nightly)
endfunction()
