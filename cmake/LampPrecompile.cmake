# The headers that most of the build time goes to, compiled once for the libraries and once for the
# tests (which have other compiler flags). Every file still includes what it uses.
# What is tested is optimised, and checked for undefined behaviour; the tests themselves would only
# take longer to compile.
set(LAMP_TEST_OPTIONS $<$<CONFIG:Release>:-O1>)
if(LAMP_SANITIZE)
  list(APPEND LAMP_TEST_OPTIONS -O0 -fno-sanitize=undefined)
endif()
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/precompile.cpp CONTENT "")  # untouched if it is there

function(lamp_precompile target)
  add_library(${target} OBJECT ${PROJECT_BINARY_DIR}/precompile.cpp)
  target_link_libraries(${target} PRIVATE lamp::dep::eigen lamp::dep::mrpt_obs lamp_warnings ${ARGN})
  target_precompile_headers(${target} PRIVATE
    <Eigen/Dense> <Eigen/Geometry>
    <mrpt/obs/CObservation2DRangeScan.h> <mrpt/obs/CObservationPointCloud.h> <mrpt/obs/CRawlog.h>
    <mrpt/poses/CPose3D.h> <mrpt/rtti/CObject.h>
    <algorithm> <filesystem> <fstream> <functional> <iostream> <map> <memory> <optional> <random>
    <set> <sstream> <string> <unordered_map> <variant> <vector>)
endfunction()

lamp_precompile(lamp_precompiled)
set_target_properties(lamp_precompiled PROPERTIES POSITION_INDEPENDENT_CODE ON)
if(LAMP_BUILD_TESTS)
  lamp_precompile(lamp_precompiled_tests GTest::gtest GTest::gmock)
  target_precompile_headers(lamp_precompiled_tests PRIVATE <gtest/gtest.h> <gmock/gmock.h>)
  target_compile_options(lamp_precompiled_tests PRIVATE ${LAMP_TEST_OPTIONS})
endif()
