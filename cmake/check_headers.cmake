# One idea is one header with its source: every source has a header of its own name beside it, so that no class is spread
# over several sources.   cmake -DROOT=<tree> -P cmake/check_headers.cmake
set(bad 0)
set(count 0)
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/common/*.cpp ${ROOT}/hal/*.cpp ${ROOT}/firmware/*.cpp
  ${ROOT}/host/*.cpp)
foreach(file IN LISTS files)
  math(EXPR count "${count} + 1")
  if(file MATCHES "/main\\.cpp$|^firmware/main/"  # a program: nobody calls it
     OR file MATCHES "^hal/[a-z0-9]+/core/image_header\\.cpp$")  # data for the boot ROM, placed by the linker script
    continue()
  endif()
  # A subcommand: declared in the list of its folder.
  get_filename_component(folder ${file} DIRECTORY)
  get_filename_component(name ${file} NAME_WE)
  if(EXISTS ${ROOT}/${folder}/commands.hpp)
    file(STRINGS ${ROOT}/${folder}/commands.hpp declared REGEX "^void add_${name}\\(")
    if(declared)
      continue()
    endif()
  endif()
  string(REGEX REPLACE "\\.cpp$" ".hpp" header "${file}")
  if(NOT EXISTS ${ROOT}/${header})
    message("${file}: has no header of its name, ${header}")
    math(EXPR bad "${bad} + 1")
  endif()
endforeach()
if(count EQUAL 0)
  message(FATAL_ERROR "there is nothing to check in ${ROOT}: give the tree's absolute path")
endif()
if(bad GREATER 0)
  message(FATAL_ERROR "${bad} of ${count} sources have no header")
endif()
message("${count} sources have their headers")
