# The libraries of the web page's module. What is headers alone comes from Debian's packages, by links, because /usr/include
# as a whole would hide Emscripten's own C library. C libraries are compiled from Debian's source packages, which
# `./dev web` unpacks into build/web-sources.
include_guard(GLOBAL)
enable_language(C)

set(headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(each boost eigen3/Eigen fast_float fmt nlohmann toml++)
  get_filename_component(name ${each} NAME)
  if(NOT EXISTS /usr/include/${each})
    message(FATAL_ERROR "there is no /usr/include/${each}: ./dev web installs it")
  endif()
  file(CREATE_LINK /usr/include/${each} ${headers}/${name} SYMBOLIC)
endforeach()

function(astro_web_headers name)
  add_library(${name} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${name} SYSTEM INTERFACE ${headers})
endfunction()
astro_web_headers(Eigen3::Eigen)
astro_web_headers(fmt::fmt)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
astro_web_headers(nlohmann_json::nlohmann_json)
astro_web_headers(tomlplusplus::tomlplusplus)
add_library(OpenSSL::Crypto INTERFACE IMPORTED GLOBAL)
add_library(Threads::Threads INTERFACE IMPORTED GLOBAL)

set(ASTROLABE_WEB_SOURCES ${CMAKE_SOURCE_DIR}/build/web-sources CACHE PATH "where the source packages are unpacked")
# astro_web_library(<target> <folder> DEFINITIONS ... INCLUDES ... SOURCES ...): sources are globs below the folder.
function(astro_web_library target folder)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "DEFINITIONS;INCLUDES;SOURCES")
  set(root ${ASTROLABE_WEB_SOURCES}/${folder})
  if(NOT EXISTS ${root})
    message(FATAL_ERROR "there is no ${ASTROLABE_WEB_SOURCES}/${folder}: ./dev web unpacks it")
  endif()
  list(TRANSFORM arg_SOURCES PREPEND ${root}/)
  list(TRANSFORM arg_INCLUDES PREPEND ${root}/)
  file(GLOB sources ${arg_SOURCES})
  string(REGEX REPLACE ".*::" "web_" name ${target})
  add_library(${name} STATIC ${sources})
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
  target_include_directories(${name} SYSTEM PUBLIC ${arg_INCLUDES})
  target_compile_definitions(${name} PRIVATE ${arg_DEFINITIONS})
  # They come over a network. Emscripten's -Oz would inline nothing.
  target_compile_options(${name} PRIVATE -w -Oz -finline-functions)
  add_library(${target} ALIAS ${name})
endfunction()
astro_web_library(BZip2::BZip2 bzip2-src INCLUDES .
  SOURCES blocksort.c huffman.c crctable.c randtable.c compress.c decompress.c bzlib.c)
astro_web_library(PkgConfig::lz4 lz4-src INCLUDES lib DEFINITIONS XXH_NAMESPACE=LZ4_ SOURCES lib/*.c)
astro_web_library(PkgConfig::sqlite3 sqlite3-src INCLUDES . SOURCES sqlite3.c DEFINITIONS
  SQLITE_THREADSAFE=0 SQLITE_OMIT_LOAD_EXTENSION SQLITE_OMIT_WAL SQLITE_OMIT_JSON SQLITE_OMIT_DEPRECATED SQLITE_OMIT_SHARED_CACHE
  SQLITE_OMIT_AUTHORIZATION SQLITE_OMIT_DECLTYPE SQLITE_OMIT_TRACE SQLITE_OMIT_UTF16)
astro_web_library(PkgConfig::tinyxml2 tinyxml2-src INCLUDES . SOURCES tinyxml2.cpp)
astro_web_library(PkgConfig::yaml libyaml-src INCLUDES include src SOURCES src/*.c DEFINITIONS
  YAML_VERSION_MAJOR=0 YAML_VERSION_MINOR=2 YAML_VERSION_PATCH=5 YAML_VERSION_STRING="0.2.5")
astro_web_library(PkgConfig::zlib zlib-src INCLUDES . DEFINITIONS HAVE_UNISTD_H Z_HAVE_UNISTD_H SOURCES
  adler32.c crc32.c inflate.c inffast.c inftrees.c zutil.c deflate.c trees.c gzread.c gzlib.c gzclose.c gzwrite.c compress.c
  uncompr.c)
# Recordings are packed by the fastest strategy alone. The others, of which none is ever chosen, would be a third of the library: their
# names in its table stand for the fastest one.
set(unused_strategies "")
foreach(dictionary "" _extDict _dictMatchState)
  foreach(strategy doubleFast btlazy2 btopt btultra)
    list(APPEND unused_strategies ZSTD_compressBlock_${strategy}${dictionary}=ZSTD_compressBlock_fast${dictionary})
  endforeach()
  foreach(strategy greedy lazy lazy2)
    foreach(row "" _row)
      list(APPEND unused_strategies
        ZSTD_compressBlock_${strategy}${dictionary}${row}=ZSTD_compressBlock_fast${dictionary}
        ZSTD_compressBlock_${strategy}_dedicatedDictSearch${row}=ZSTD_compressBlock_fast_dictMatchState)
    endforeach()
  endforeach()
endforeach()
list(REMOVE_DUPLICATES unused_strategies)
list(APPEND unused_strategies ZSTD_compressBlock_btultra2=ZSTD_compressBlock_fast)
astro_web_library(PkgConfig::zstd libzstd-src INCLUDES lib DEFINITIONS XXH_NAMESPACE=ZSTD_ ZSTD_DISABLE_ASM SOURCES
  lib/common/*.c lib/compress/*.c lib/decompress/*.c)
# Only the file with the table: the others define them.
set_source_files_properties(${ASTROLABE_WEB_SOURCES}/libzstd-src/lib/compress/zstd_compress.c PROPERTIES
  COMPILE_DEFINITIONS "${unused_strategies}")
