# Shared by the build and by the installed CMake package.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(SUNDIALS 6 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(NLopt REQUIRED)
find_package(ZLIB REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C HL)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(openblas REQUIRED IMPORTED_TARGET openblas)
find_package(CLI11 REQUIRED)

# Debian's SuiteSparse ships neither CMake nor pkg-config files.
if(NOT TARGET strainwave::cholmod)
  find_path(CHOLMOD_INCLUDE cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
  find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
  add_library(strainwave::cholmod INTERFACE IMPORTED)
  set_target_properties(strainwave::cholmod PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE}" INTERFACE_LINK_LIBRARIES "${CHOLMOD_LIBRARY}")
endif()
if(NOT TARGET strainwave::hdf5)
  add_library(strainwave::hdf5 INTERFACE IMPORTED)
  set_target_properties(strainwave::hdf5 PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${HDF5_C_INCLUDE_DIRS}" INTERFACE_LINK_LIBRARIES "${HDF5_C_LIBRARIES};${HDF5_C_HL_LIBRARIES}")
endif()
