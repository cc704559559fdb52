# astro_test(common.kinematics SOURCES odometry_test.cpp DEPENDS common.kinematics)
#   one GoogleTest program named <name>.test. In a build without sanitizers each TEST becomes a ctest of its own name; under
#   the sanitizers a program is one ctest, or four if it is LONG.
#   OPTIMISED   sources that take longer to run than to compile
#   LONG        some of the program's tests take many seconds: it is started first, so that no processor waits for it in
#               the end
#   PLAIN       a program that the sanitizers leave out: whole programs on the emulated chip, campaigns of power cuts. What of
#               the host's code it walks through, shorter programs walk through under them, but for its own rig
#   ON_DEMAND   a program that `./dev check` leaves out under the sanitizers and `./dev fuzz 60 sanitizers` does not: the real
#               programs as processes, and what goes once more through code that shorter tests go through under them
#   REPEATING   tests, by GoogleTest's patterns, that the sanitizers leave out because they do a hundred times what others
#               do once
# `./dev test` runs all of them, `./dev check` those that the sanitizers take each time.
find_package(GTest REQUIRED)
find_package(Threads REQUIRED)
include(GoogleTest)

# How the tests' own code is compiled: not optimised, because most of what a test costs is compiling it. What it calls is
# optimised as ever, by the way the programs are linked. Linked last, so that it overrides astro_compile.
add_library(astro_test_compile INTERFACE)
target_compile_options(astro_test_compile INTERFACE -O0)
# So that ccache can keep what includes a precompiled header.
if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
  target_compile_options(astro_test_compile INTERFACE "SHELL:-Xclang -fno-pch-timestamp")
else()
  target_compile_options(astro_test_compile INTERFACE -fpch-preprocess)
endif()
if(ASTROLABE_SANITIZE)
  # What is checked is the code under test. The checks named here cost the most time to compile, and in the
  # tests' own code AddressSanitizer catches what they would.
  target_compile_options(astro_test_compile INTERFACE
    -fno-sanitize=null,alignment,object-size,vptr,pointer-overflow,nonnull-attribute,returns-nonnull-attribute)
endif()

# Some hundred programs of tests and benchmarks are linked, each from most of the libraries: mold does it in a fourth of the
# time. For all of the folder that includes this.
find_program(ASTROLABE_MOLD mold)
if(ASTROLABE_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

# What nearly every test includes, read once. A test still includes what it uses.
file(WRITE ${CMAKE_BINARY_DIR}/astro_test_headers.cpp "")
add_library(astro_test_headers OBJECT ${CMAKE_BINARY_DIR}/astro_test_headers.cpp)
target_link_libraries(astro_test_headers PRIVATE astro_compile
  GTest::gmock GTest::gtest_main Threads::Threads astro_test_compile)
target_precompile_headers(astro_test_headers PRIVATE
  <gmock/gmock.h> <gtest/gtest.h> <algorithm> <array> <chrono> <cmath> <cstdint> <cstdio> <filesystem> <fstream>
  <functional> <map> <memory> <numbers> <optional> <random> <span> <sstream> <string> <string_view> <vector>)

# Builds what the tests of this build run, and nothing else. What a test runs besides an astro_test joins by astro_tests_run.
add_custom_target(astro_tests)
function(astro_tests_run)
  add_dependencies(astro_tests ${ARGN})
endfunction()

function(astro_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "LONG;PLAIN;ON_DEMAND" "" "SOURCES;OPTIMISED;REPEATING;DEPENDS;LIBRARIES")
  add_executable(${name}.test ${arg_SOURCES})
  target_link_libraries(${name}.test PRIVATE astro_compile ${arg_DEPENDS} ${arg_LIBRARIES} tests.support.places
    GTest::gmock GTest::gtest_main Threads::Threads astro_test_compile)
  target_precompile_headers(${name}.test REUSE_FROM astro_test_headers)
  set(linker ${CMAKE_SOURCE_DIR}/cmake/link_optimised_first.sh)
  set_target_properties(${name}.test PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests
    CXX_LINKER_LAUNCHER ${linker} LINK_DEPENDS ${linker})
  # The precompiled headers are not optimised, and GCC refuses to mix. -O1: more finds warnings that are none in checks.
  set_source_files_properties(${arg_OPTIMISED} PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON
    COMPILE_OPTIONS $<IF:$<BOOL:${ASTROLABE_SANITIZE}>,-O1,-O2>)
  set(cost 0)
  if(arg_LONG)
    set(cost 1)
  endif()
  list(JOIN arg_REPEATING ":" repeating)
  # RapidCheck: the same cases each time.
  set(environment "RC_PARAMS=seed=20240711")
  if(ASTROLABE_SANITIZE)
    # Debian's libfastrtps deletes its endpoints as another type than it has made.
    list(APPEND environment "ASAN_OPTIONS=new_delete_type_mismatch=0")
    if(arg_PLAIN OR (arg_ON_DEMAND AND NOT ASTROLABE_SANITIZE_ALL))
      set_target_properties(${name}.test PROPERTIES EXCLUDE_FROM_ALL TRUE)
      return()
    endif()
    astro_tests_run(${name}.test)
    # Many tests in one process: to start a program costs more under the sanitizers than most tests.
    set(shards 1)
    if(arg_LONG)
      set(shards 4)
    endif()
    foreach(shard RANGE 1 ${shards})
      math(EXPR index "${shard} - 1")
      add_test(NAME "${name}: ${shard} of ${shards}" COMMAND ${name}.test --gtest_brief=1 "--gtest_filter=-${repeating}")
      set_tests_properties("${name}: ${shard} of ${shards}" PROPERTIES TIMEOUT 900 COST ${cost}
        ENVIRONMENT "${environment};GTEST_TOTAL_SHARDS=${shards};GTEST_SHARD_INDEX=${index}")
    endforeach()
  else()
    astro_tests_run(${name}.test)
    gtest_discover_tests(${name}.test TEST_PREFIX "${name}: " DISCOVERY_TIMEOUT 60
      PROPERTIES TIMEOUT 300 COST ${cost} ENVIRONMENT "${environment}")
  endif()
endfunction()
