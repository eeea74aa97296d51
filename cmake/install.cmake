# cmake --install: the program, the libraries, their public headers and a CMake package `find_package(strainwave)`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(${CMAKE_CURRENT_LIST_DIR}/components.cmake)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/strainwave)
set(STRAINWAVE_COMPONENTS_TEXT "set(strainwave_components ${strainwave_components})\n")
foreach(component ${strainwave_components})
  strainwave_targets_of(targets ${strainwave_component_${component}_rooms})
  if(component STREQUAL "forward")
    list(APPEND targets strainwave_options)
  endif()
  install(TARGETS ${targets} EXPORT strainwave-${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} FILE_SET HEADERS)
  install(EXPORT strainwave-${component} NAMESPACE strainwave:: DESTINATION ${package})
  set(exported ${strainwave_component_${component}_rooms})
  list(TRANSFORM exported REPLACE "/" "_")
  list(TRANSFORM exported PREPEND "strainwave::")
  string(APPEND STRAINWAVE_COMPONENTS_TEXT
    "set(strainwave_${component}_needs ${strainwave_component_${component}_needs})\n"
    "set(strainwave_${component}_libraries ${strainwave_component_${component}_libraries})\n"
    "set(strainwave_${component}_targets ${exported})\n")
endforeach()
install(TARGETS strainwave RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/studies/gallery DESTINATION ${CMAKE_INSTALL_DATADIR}/strainwave)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/strainwaveConfig.cmake.in
  ${PROJECT_BINARY_DIR}/strainwaveConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/strainwaveConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/strainwaveConfig.cmake ${PROJECT_BINARY_DIR}/strainwaveConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/find_dependencies.cmake DESTINATION ${package})
