# astro_test(common.kinematics SOURCES odometry_test.cpp DEPENDS common.kinematics)
#   one GoogleTest program named <name>.test; each TEST becomes a ctest of its own name.
find_package(GTest REQUIRED)
find_package(Threads REQUIRED)
include(GoogleTest)

function(astro_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;DEPENDS;LIBRARIES")
  add_executable(${name}.test ${arg_SOURCES})
  target_link_libraries(${name}.test PRIVATE astro_compile ${arg_DEPENDS} ${arg_LIBRARIES}
    GTest::gmock GTest::gtest_main Threads::Threads)
  if(ASTROLABE_SANITIZE)
    # What is checked is the code under test. The checks named here cost the most time to compile, and in the
    # tests' own code AddressSanitizer catches what they would.
    target_compile_options(${name}.test PRIVATE -O0
      -fno-sanitize=null,alignment,object-size,vptr,nonnull-attribute,returns-nonnull-attribute)
  endif()
  set_target_properties(${name}.test PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  # Real data lives beside a developer's checkout only; tests that use it skip where it is absent.
  target_compile_definitions(${name}.test PRIVATE
    ASTRO_SOURCE_DIR="${CMAKE_SOURCE_DIR}" ASTRO_SHARED_DATA="${CMAKE_SOURCE_DIR}/../shared/data")
  gtest_discover_tests(${name}.test TEST_PREFIX "${name}: " DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 300 ENVIRONMENT "RC_PARAMS=seed=20240711")  # RapidCheck: the same cases each time
endfunction()
