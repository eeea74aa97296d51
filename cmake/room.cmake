# A room is one folder with one concept and one library. The link lines below are the architecture: a room can include
# another one only if it names it (docs/architecture.md, cmake/arrows.py).
#
#   strainwave_room(USES common/core model/gear  LIBRARIES …  PRIVATE …  PRIVATE_HEADERS …  EXCEPT …)
#     USES             rooms whose headers this room includes
#     LIBRARIES        outside libraries seen in its public headers;  PRIVATE: only in its sources
#     PRIVATE_HEADERS  of this room only: included from nowhere else, not installed
#     EXCEPT           sources that are not compiled here
#     ALONE            sources that are not read in one go with the others (below)
#
# The room's sources and headers are those in its folder. Its target is strainwave_ and its path with _ for /.
# Headers are included as "strainwave/<folder>/<name>.hpp".
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/include/strainwave)
foreach(folder common model optimize studies)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${PROJECT_BINARY_DIR}/include/strainwave/${folder} SYMBOLIC)
endforeach()

# Reading headers and making the same templates again and again is most of a build: a room's sources are compiled
# together, a dozen at a time. Off in the preset dev, where one changed source should cost one source.
option(STRAINWAVE_UNITY "compile the sources of a room together" ON)

add_library(strainwave_options INTERFACE)
target_compile_features(strainwave_options INTERFACE cxx_std_20)
# The layout of Eigen's types follows their alignment, which would else follow the instruction set.
target_compile_definitions(strainwave_options INTERFACE EIGEN_MAX_ALIGN_BYTES=64)
target_include_directories(strainwave_options INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
# What only this build says: never exported.
add_library(strainwave_build INTERFACE)
if(STRAINWAVE_ARCH)
  target_compile_options(strainwave_build INTERFACE -march=${STRAINWAVE_ARCH})
endif()
# g++ 12's own AVX-512 headers draw (maybe-)uninitialized (GCC bug 105593), seen through Eigen's products.
target_compile_options(strainwave_build INTERFACE -Wall -Wextra -Wpedantic -Wno-maybe-uninitialized
  -Wno-uninitialized $<$<BOOL:${STRAINWAVE_WERROR}>:-Werror>)
if(NOT STRAINWAVE_UNITY) # together, a local name may be another source's
  target_compile_options(strainwave_build INTERFACE -Wshadow)
endif()
target_include_directories(strainwave_build INTERFACE ${PROJECT_SOURCE_DIR})

include(cmake/precompiled.cmake)

# The sources of a target read in one go, but for those named.
function(strainwave_unite target)
  if(STRAINWAVE_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    foreach(name ${ARGN})
      set_source_files_properties(${name} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endforeach()
  endif()
endfunction()

function(strainwave_target_of room result)
  string(REPLACE "/" "_" name ${room})
  set(${result} strainwave_${name} PARENT_SCOPE)
endfunction()

# Names of rooms become their targets.
function(strainwave_targets_of result)
  set(targets "")
  foreach(room ${ARGN})
    strainwave_target_of(${room} target)
    list(APPEND targets ${target})
  endforeach()
  set(${result} ${targets} PARENT_SCOPE)
endfunction()

function(strainwave_room)
  cmake_parse_arguments(ROOM "" "" "USES;LIBRARIES;PRIVATE;PRIVATE_HEADERS;EXCEPT;ALONE" ${ARGN})
  file(RELATIVE_PATH room ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  strainwave_target_of(${room} target)
  strainwave_targets_of(uses ${ROOM_USES})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/*.hpp)
  foreach(name ${ROOM_EXCEPT})
    list(REMOVE_ITEM sources ${CMAKE_CURRENT_SOURCE_DIR}/${name})
  endforeach()
  if(ROOM_PRIVATE_HEADERS)
    list(REMOVE_ITEM headers ${ROOM_PRIVATE_HEADERS})
  endif()
  list(TRANSFORM headers PREPEND ${PROJECT_BINARY_DIR}/include/strainwave/${room}/)
  add_library(${target} STATIC ${sources})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_BINARY_DIR}/include FILES ${headers})
  target_link_libraries(${target} PUBLIC strainwave_options ${uses} ${ROOM_LIBRARIES}
    PRIVATE ${ROOM_PRIVATE} $<BUILD_INTERFACE:strainwave_build>)
  string(REPLACE "/" "_" export_name ${room})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${export_name} POSITION_INDEPENDENT_CODE ON
    VERIFY_INTERFACE_HEADER_SETS ON)
  add_library(strainwave::${export_name} ALIAS ${target})
  strainwave_precompile(${target} ${ROOM_LIBRARIES} ${ROOM_PRIVATE})
  list(TRANSFORM ROOM_ALONE PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  strainwave_unite(${target} ${ROOM_ALONE})
  set_property(GLOBAL APPEND PROPERTY STRAINWAVE_ROOMS ${room})
  set_property(GLOBAL PROPERTY STRAINWAVE_USES_${room} ${ROOM_USES})
  set_property(GLOBAL PROPERTY STRAINWAVE_LIBRARIES_${room} ${ROOM_LIBRARIES} ${ROOM_PRIVATE})
endfunction()

# BLAS kernels of three generations, those that this processor can run: OpenBLAS does not check a name that it is given.
set(STRAINWAVE_BLAS_KERNELS Prescott)
if(EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo flags REGEX "^flags" LIMIT_COUNT 1)
  foreach(pair avx2:Haswell avx512vl:SkylakeX)
    string(REPLACE ":" ";" pair ${pair})
    list(GET pair 0 flag)
    list(GET pair 1 kernel)
    if(flags MATCHES " ${flag}( |$)")
      list(APPEND STRAINWAVE_BLAS_KERNELS ${kernel})
    endif()
  endforeach()
endif()

# strainwave_test(NAME FINITE_ELEMENTS USES … LIBRARIES … SOURCES … ALONE …): one test program of the *_test.cpp in this folder, or
# of the named sources. Tests whose suite name ends in "Nightly" run only under the label nightly (./run test --nightly).
# FINITE_ELEMENTS: it solves cups, with BLAS kernels that are chosen by processor at run time and round differently; the
# nightly run repeats it with those of three generations.
function(strainwave_test name)
  cmake_parse_arguments(T "FINITE_ELEMENTS" "" "SOURCES;USES;LIBRARIES;ALONE" ${ARGN})
  if(NOT T_SOURCES)
    file(GLOB T_SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  endif()
  strainwave_targets_of(uses ${T_USES})
  add_executable(test_${name} ${T_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${uses} ${T_LIBRARIES} strainwave_build GTest::gtest GTest::gtest_main)
  target_compile_definitions(test_${name} PRIVATE
    STRAINWAVE_TEST_REFERENCE="${PROJECT_SOURCE_DIR}/tests/reference" STRAINWAVE_SOURCE="${PROJECT_SOURCE_DIR}")
  strainwave_precompile_test(test_${name} ${T_LIBRARIES})
  list(TRANSFORM T_ALONE PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  strainwave_unite(test_${name} ${T_ALONE})
  add_test(NAME ${name} COMMAND test_${name} --gtest_filter=-*Nightly.*)
  add_test(NAME ${name}.nightly COMMAND test_${name} --gtest_filter=*Nightly.*)
  set_tests_properties(${name}.nightly PROPERTIES LABELS nightly)
  if(T_FINITE_ELEMENTS)
    foreach(kernel ${STRAINWAVE_BLAS_KERNELS})
      add_test(NAME ${name}.${kernel} COMMAND test_${name} --gtest_filter=-*Nightly.*)
      set_tests_properties(${name}.${kernel} PROPERTIES LABELS nightly ENVIRONMENT OPENBLAS_CORETYPE=${kernel})
    endforeach()
  endif()
  if(STRAINWAVE_NO_SKIPS)
    set_tests_properties(${name} ${name}.nightly PROPERTIES FAIL_REGULAR_EXPRESSION "SKIPPED .* test")
  endif()
endfunction()
