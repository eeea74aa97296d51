# cmake --install: the program, the libraries, the headers and a CMake package `find_package(strainwave)`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(rooms GLOBAL PROPERTY STRAINWAVE_ROOMS)
install(TARGETS ${rooms} EXPORT strainwaveTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} FILE_SET HEADERS)
install(TARGETS strainwave RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/studies/gallery DESTINATION ${CMAKE_INSTALL_DATADIR}/strainwave)
install(EXPORT strainwaveTargets NAMESPACE strainwave:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/strainwave)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/strainwaveConfig.cmake.in
  ${PROJECT_BINARY_DIR}/strainwaveConfig.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/strainwave)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/strainwaveConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/strainwaveConfig.cmake ${PROJECT_BINARY_DIR}/strainwaveConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/find_dependencies.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/strainwave)
