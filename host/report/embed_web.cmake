# astro_embed_web(<out> <web> <build>): sets <out> to the C++ source that puts the files of the folder <web> and
# the plotting library from npm into the program (host/report/assets.hpp).
#
# npm works on copies in <build>, so the source tree never holds a node_modules. `.incbin` lets the assembler
# read the bytes: a megabyte of library as a char array costs the compiler seconds and half a gigabyte.
function(astro_embed_web out web build)
  find_program(ASTROLABE_NPM npm)
  if(NOT ASTROLABE_NPM)
    message(FATAL_ERROR "The report embeds a plotting library from npm, and npm is not here; install npm: ./dev setup")
  endif()

  set(npm ${build}/web)
  file(MAKE_DIRECTORY ${npm})
  set(library ${npm}/node_modules/plotly.js-basic-dist-min/plotly-basic.min.js)
  add_custom_command(OUTPUT ${library}
    COMMAND ${CMAKE_COMMAND} -E copy ${web}/package.json ${web}/package-lock.json ${npm}
    COMMAND ${ASTROLABE_NPM} ci --ignore-scripts --no-audit --no-fund --prefer-offline --loglevel=error
    # npm keeps the package's own time stamp, which is older than the lock file.
    COMMAND ${CMAKE_COMMAND} -E touch ${library}
    DEPENDS ${web}/package.json ${web}/package-lock.json
    WORKING_DIRECTORY ${npm}
    COMMENT "npm ci: the plotting library of the report"
    VERBATIM)

  set(names library_js script_js style_css template_html)
  set(files ${library} ${web}/report.js ${web}/report.css ${web}/template.html)
  set(code "#include \"host/report/assets.hpp\"\n")
  foreach(name file IN ZIP_LISTS names files)
    set(symbol astro_report_${name})
    if(ASTROLABE_TARGET STREQUAL "web")  # each symbol in a section of its own, with its size
      set(section ".section .rodata.${symbol},\"\",@")
      set(sized ".Lend_${symbol}:\n.size ${symbol}, .Lend_${symbol}-${symbol}")
      set(length ".section .rodata.${symbol}_length,\"\",@\n.p2align 2")
      set(length_sized ".size ${symbol}_length, 4\n.text")
    else()
      set(section ".section .rodata")
      set(sized ".Lend_${symbol}:\n.byte 0")
      set(length ".p2align 2")
      set(length_sized ".previous")
    endif()
    string(APPEND code "
asm(R\"(${section}
.globl ${symbol}
.type ${symbol},@object
${symbol}:
.incbin \"${file}\"
${sized}
${length}
.globl ${symbol}_length
.type ${symbol}_length,@object
${symbol}_length:
.4byte .Lend_${symbol}-${symbol}
${length_sized})\");
extern \"C\" const char ${symbol}[];
extern \"C\" const unsigned ${symbol}_length;
std::string_view astro::report::assets::${name}() { return {${symbol}, ${symbol}_length}; }
")
  endforeach()
  set(source ${build}/assets.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "${code}" @ONLY)
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${files}")
  set(${out} ${source} PARENT_SCOPE)
endfunction()
