# Several sources are compiled as one: most of what a file costs to compile is what its neighbours include and instantiate, too.
# CMake's own UNITY_BUILD names the sources by their absolute paths, so that a compiler cache does not know them again in another
# checkout before it has preprocessed them. These files name them from the root of the checkout, as all includes do.

set(ASTROLABE_UNITY 8 CACHE STRING "how many source files of a host build are compiled at a time; 1: each alone")

# astro_alone(files...): compiled each alone, because a name in them also stands, with another meaning, in another file of
# the target.
function(astro_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# The targets with the property UNITY_BUILD, which is how they are born; a target may switch it off.
if(ASTROLABE_TARGET MATCHES "^(host|web)$" AND ASTROLABE_UNITY GREATER 1)
  set(CMAKE_UNITY_BUILD ON)
endif()

# astro_unite(): at the end of the top folder, when all targets are known.
function(astro_unite)
  astro_unite_below(${CMAKE_SOURCE_DIR})
endfunction()

function(astro_unite_below directory)
  get_property(below DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(each IN LISTS below)
    astro_unite_below(${each})
  endforeach()
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(unite ${target} UNITY_BUILD)
    if(unite)
      astro_unite_target(${target})
    endif()
  endforeach()
endfunction()

function(astro_unite_target target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  get_target_property(sources ${target} SOURCES)
  get_target_property(from ${target} SOURCE_DIR)
  get_target_property(to ${target} BINARY_DIR)
  set(together)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${from} NORMALIZE OUTPUT_VARIABLE path)
    cmake_path(IS_PREFIX CMAKE_BINARY_DIR ${path} generated)
    get_source_file_property(alone ${path} TARGET_DIRECTORY ${target} SKIP_UNITY_BUILD_INCLUSION)
    if(path MATCHES "\\.cpp$" AND NOT generated AND NOT alone)
      list(APPEND together ${path})
    endif()
  endforeach()
  list(LENGTH together count)
  if(count LESS 2)
    return()
  endif()
  math(EXPR last "${count} - 1")
  foreach(begin RANGE 0 ${last} ${ASTROLABE_UNITY})
    list(SUBLIST together ${begin} ${ASTROLABE_UNITY} batch)
    set(text "// Made by cmake/AstroUnity.cmake.\n")
    foreach(path IN LISTS batch)
      cmake_path(RELATIVE_PATH path BASE_DIRECTORY ${CMAKE_SOURCE_DIR})
      string(APPEND text "#include \"${path}\"\n")
    endforeach()
    set(file ${to}/unity/${target}.${begin}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
    target_sources(${target} PRIVATE ${file})
  endforeach()
  set_source_files_properties(${together} TARGET_DIRECTORY ${target} PROPERTIES HEADER_FILE_ONLY ON)
endfunction()
