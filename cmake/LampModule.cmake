# add_lamp_module(<name> [PUBLIC <target>...] [PRIVATE <target>...] [TEST <target>...])
#
# Builds the shared library lamp-<name> (target lamp::<name>) from src/*.cpp and, with tests on,
# the one test program <name>_test from tests/*.cpp. Shared, because plugins that are loaded at run
# time must find the same class registry as the application.
function(add_lamp_module name)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE;TEST" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/*.cpp)
  add_library(lamp_${name} SHARED ${sources})
  add_library(lamp::${name} ALIAS lamp_${name})
  set_target_properties(lamp_${name} PROPERTIES
    OUTPUT_NAME lamp-${name} EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  target_include_directories(lamp_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(lamp_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_compile_features(lamp_${name} PUBLIC cxx_std_17)
  target_link_libraries(lamp_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE}
    $<BUILD_INTERFACE:lamp_warnings>)
  target_precompile_headers(lamp_${name} REUSE_FROM lamp_precompiled)
  install(TARGETS lamp_${name} EXPORT mrpt_lamp DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

  file(GLOB tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/tests/*_test.cpp)
  if(LAMP_BUILD_TESTS AND tests)
    lamp_add_test(${name}_test unit ${tests})
    target_link_libraries(${name}_test PRIVATE lamp::${name} ${ARG_PRIVATE} ${ARG_TEST})
    target_include_directories(${name}_test PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  endif()
endfunction()

# lamp_add_test(<target> <label> <sources>...): a GoogleTest program whose tests CTest lists one by one.
function(lamp_add_test target label)
  add_executable(${target} ${ARGN})
  target_link_libraries(${target} PRIVATE GTest::gtest GTest::gmock GTest::gtest_main lamp_warnings)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
  target_compile_options(${target} PRIVATE ${LAMP_TEST_OPTIONS})
  target_precompile_headers(${target} REUSE_FROM lamp_precompiled_tests)
  target_compile_definitions(${target} PRIVATE
    LAMP_SOURCE_DIR="${PROJECT_SOURCE_DIR}" LAMP_BINARY_DIR="${PROJECT_BINARY_DIR}")
  include(GoogleTest)
  gtest_discover_tests(${target} PROPERTIES LABELS ${label} DISCOVERY_MODE PRE_TEST)
endfunction()
