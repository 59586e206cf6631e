include(CMakePackageConfigHelpers)
set(LAMP_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/mrpt_lamp)
install(EXPORT mrpt_lamp NAMESPACE lamp:: DESTINATION ${LAMP_CMAKE_DIR} FILE mrpt_lamp-targets.cmake)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/mrpt_lamp-config.cmake.in
  ${PROJECT_BINARY_DIR}/mrpt_lamp-config.cmake INSTALL_DESTINATION ${LAMP_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mrpt_lamp-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mrpt_lamp-config.cmake
  ${PROJECT_BINARY_DIR}/mrpt_lamp-config-version.cmake DESTINATION ${LAMP_CMAKE_DIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/ini/ DESTINATION ${CMAKE_INSTALL_DATADIR}/mrpt_lamp/ini)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs)
