# What `cmake --install` puts where, and the package that find_package(anisomesh) finds.
include(CMakePackageConfigHelpers)

set_target_properties(anisomesh PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
  POSITION_INDEPENDENT_CODE ON DEFINE_SYMBOL "")
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/anisomesh)

install(TARGETS anisomesh EXPORT anisomesh_targets)
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include/anisomesh DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.hh")
install(EXPORT anisomesh_targets NAMESPACE anisomesh:: DESTINATION ${package_folder} FILE anisomesh-targets.cmake)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/anisomesh-config.cmake.in
  ${PROJECT_BINARY_DIR}/anisomesh-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/anisomesh-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/anisomesh-config.cmake ${PROJECT_BINARY_DIR}/anisomesh-config-version.cmake
  DESTINATION ${package_folder})
