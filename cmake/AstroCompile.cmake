# How everything is compiled. One language level, one set of warnings.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
# -O2 on purpose: the tick is counted in instructions, and -O3 trades them for code size.
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1")

option(ASTROLABE_WERROR "warnings are errors: `./dev` and CI set it; another compiler may warn of what is no fault" OFF)
option(ASTROLABE_SANITIZE "AddressSanitizer and UBSan, any finding ends the program" OFF)
option(ASTROLABE_SANITIZE_ALL "with the sanitizers: also the tests that `./dev check` leaves to `./dev fuzz`" OFF)
option(ASTROLABE_FUZZ "libFuzzer targets instead of tests; needs clang" OFF)
option(ASTROLABE_COVERAGE "gcov instrumentation" OFF)

add_library(astro_compile INTERFACE)
target_include_directories(astro_compile INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(astro_compile INTERFACE
  -Wall -Wextra -Wconversion -Wdouble-promotion -Wshadow -Wnon-virtual-dtor $<$<BOOL:${ASTROLABE_WERROR}>:-Werror>)
if(ASTROLABE_TARGET STREQUAL host)  # main() has no declaration on a bare machine
  target_compile_options(astro_compile INTERFACE -Wmissing-declarations)
endif()
set(ASTRO_PROCESSOR_teensy40 cortex-m7)
set(ASTRO_PROCESSOR_rp2040 cortex-m0plus)
if(ASTRO_PROCESSOR_${ASTROLABE_TARGET})
  # Not in the toolchain file, whose flags an existing build would keep when they change.
  # Soft float on purpose: a float that slips in becomes a library call, which the image check finds by name.
  # -fno-schedule-insns: the first scheduling pass fills the registers with early loads and then spills them; without
  # it the control tick is a tenth shorter.
  # -fno-jump-tables: a jump through a table of addresses looks like a call through a pointer, which the check of the
  # stack could not follow.
  # -flto-partition=one: what the tick costs must not depend on where the linker cuts the program in two.
  set(bare_metal -mcpu=${ASTRO_PROCESSOR_${ASTROLABE_TARGET}} -mthumb -mfloat-abi=soft -ffreestanding -fno-exceptions -fno-rtti
    -fno-threadsafe-statics -fno-use-cxa-atexit -fno-common -fno-schedule-insns -fno-jump-tables
    -ffunction-sections -fdata-sections -flto=auto -flto-partition=one)
  target_compile_options(astro_compile INTERFACE ${bare_metal})
  # -fstack-usage is for the link alone, where the code is generated and the list is written. ccache keeps no object whose
  # compiler was asked for a list and wrote none.
  target_link_options(astro_compile INTERFACE ${bare_metal} -fstack-usage)
endif()
if(ASTROLABE_TARGET STREQUAL web)
  # Debian's Emscripten has libc++ 13, whose ranges are not finished. Its compiler and its library go with the headers of 16.
  target_compile_options(astro_compile INTERFACE -w -fwasm-exceptions -nostdinc++
    "SHELL:-isystem ${CMAKE_SOURCE_DIR}/host/page/wasm/libcxx" "SHELL:-isystem /usr/lib/llvm-16/include/c++/v1"
    "SHELL:-include ${CMAKE_SOURCE_DIR}/host/page/wasm/libcxx/chars.hpp")
  target_link_options(astro_compile INTERFACE -fwasm-exceptions)
endif()
if(ASTROLABE_SANITIZE)
  # By clang, which compiles the checks in half the time that GCC takes and sees other things. GCC's warnings are the
  # ones that count: the host build has them all as errors.
  target_compile_options(astro_compile INTERFACE -w
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -O1 -g1)
  target_compile_definitions(astro_compile INTERFACE ASTRO_SANITIZE)
  target_link_options(astro_compile INTERFACE -fsanitize=address,undefined)
endif()
if(ASTROLABE_FUZZ)
  # GCC's warnings are the ones that count; clang has others. Coverage counters in everything, libFuzzer's main in the targets only.
  target_compile_options(astro_compile INTERFACE -w
    -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -O1 -g1)
  target_link_options(astro_compile INTERFACE -fsanitize=address,undefined)
endif()
# For code that only the desk runs. The checks of pointers for null, alignment, size and overflow cost a third of its
# compilation and half of its run time, because they keep small functions from being inlined, and there AddressSanitizer finds
# every invalid access. What the robot runs has all checks.
add_library(astro_desk_sanitize INTERFACE)
if(ASTROLABE_SANITIZE)
  target_compile_options(astro_desk_sanitize INTERFACE -fno-sanitize=null,alignment,object-size,vptr,pointer-overflow)
endif()
# For code that takes longer to compile than it ever runs, in the build under the sanitizers: not optimised. To be linked
# last: it overrides astro_compile.
add_library(astro_quick_sanitize INTERFACE)
if(ASTROLABE_SANITIZE)
  target_compile_options(astro_quick_sanitize INTERFACE -O0)
endif()
# And for the opposite: what computes in inner loops would run for minutes at -O1.
add_library(astro_fast_sanitize INTERFACE)
if(ASTROLABE_SANITIZE)
  target_compile_options(astro_fast_sanitize INTERFACE -O2)
endif()
if(ASTROLABE_COVERAGE)
  target_compile_options(astro_compile INTERFACE --coverage -O0)
  target_link_options(astro_compile INTERFACE --coverage)
endif()

find_program(ASTROLABE_CCACHE ccache)
if(ASTROLABE_CCACHE)
  # The sloppiness is what ccache asks for before it keeps what includes a precompiled header (the tests).
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${ASTROLABE_CCACHE})
endif()
