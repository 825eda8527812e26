# Installs the libraries, their headers and a package config, so that find_package(tinwright) works.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tinwright)

# Two export sets: whoever asks for the component `core` alone needs no GDAL.
install(
  TARGETS tinwright
  EXPORT tinwright-core-targets
  FILE_SET HEADERS)
install(
  TARGETS tinwright_io
  EXPORT tinwright-io-targets
  FILE_SET HEADERS)
foreach(component core io)
  install(
    EXPORT tinwright-${component}-targets
    NAMESPACE tinwright::
    DESTINATION ${package_dir})
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tinwright-config.cmake.in
                              ${PROJECT_BINARY_DIR}/tinwright-config.cmake INSTALL_DESTINATION ${package_dir})
# Until 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tinwright-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tinwright-config.cmake ${PROJECT_BINARY_DIR}/tinwright-config-version.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindGeographicLib.cmake
        DESTINATION ${package_dir})

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
