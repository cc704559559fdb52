# What names an option, a subcommand or the program stands with the command that has it (host/commands/base/advice.hpp):
# outside host/commands and host/programs no text does, and nothing prints.   cmake -DROOT=<tree> -P cmake/check_wording.cmake
cmake_policy(VERSION 3.21)
set(bad 0)
set(count 0)

# Texts in which the program's name is part of a format or of a protocol, so that it cannot change. File:text.
set(format_constants
  "host/python/native/main.cpp:astrolabe.errors"          # the module with the package's exceptions
  "host/recording/run_writer.cpp:astrolabe"               # the writing library, in the header of an MCAP file
  "host/recording/run_metadata.hpp:astrolabe.run"         # the metadata record of a run
  "host/formats/messages/telemetry.hpp:astrolabe_msgs/msg/Telemetry"
  "host/recording/sample_messages.cpp:astrolabe_msgs/msg/WheelCounts"
  "host/recording/sample_messages.cpp:astrolabe_msgs/msg/GyroSlip"
  "host/robot/port/ports.cpp:astrolabe-"                  # the folder of simulated ports
  "host/robot/sharing/port_socket.cpp:astrolabe-"         # the socket of a shared port
  "host/robot/sharing/relay_server.cpp:astrolabe-relay"   # the thread's name, as `ps` and debuggers show it
  "host/simulation/server/path_claim.cpp:astrolabe-pty-{:016x}"  # the lock of a simulated port
  "host/simulation/server/truth_server.cpp:astrolabe-mocap 1\\n"
  "host/simulation/study/shard_file.cpp:astrolabe study 3"
  "host/film/picture/film_info.cpp:-i"                    # arguments of ffmpeg
  "host/film/picture/frame_stream.cpp:-f"
  "host/truth/live/socket_source.cpp:astrolabe-mocap 1")

# A subcommand is a file of its name: calibrate_runs.cpp is `calibrate runs`, check_wiring.cpp is `check-wiring`.
# A name of one word is looked for in quotes only, because it is mostly an everyday word, too.
set(names "")
set(long_names "")
file(GLOB sources RELATIVE ${ROOT} ${ROOT}/host/commands/*/*.cpp)
foreach(source IN LISTS sources)
  get_filename_component(name ${source} NAME_WE)
  string(REPLACE "_" "[- ]" pattern ${name})
  list(APPEND names ${pattern})
  if(name MATCHES "_")
    list(APPEND long_names ${pattern})
  endif()
endforeach()
list(JOIN names "|" names)
list(JOIN long_names "|" long_names)

# Sets `out` to the text literals of C++ code, without their quotes. Literals that stand side by side are one.
function(literals_of text out)
  string(REGEX REPLACE "(^|\n)[ \t]*(//|#)[^\n]*" "\\1" text "${text}")
  string(REGEX REPLACE "[ \t]// [^\n]*" "" text "${text}")
  set(plain "")
  while(text MATCHES "R\"([^(\n]*)\\(")  # a raw string may have several lines, and quotes inside
    set(open "${CMAKE_MATCH_0}")
    set(close ")${CMAKE_MATCH_1}\"")
    string(LENGTH "${open}" open_length)
    string(LENGTH "${close}" close_length)
    string(FIND "${text}" "${open}" from)
    string(SUBSTRING "${text}" 0 ${from} before)
    math(EXPR from "${from} + ${open_length}")
    string(SUBSTRING "${text}" ${from} -1 text)
    string(FIND "${text}" "${close}" length)
    string(SUBSTRING "${text}" 0 ${length} inside)
    math(EXPR from "${length} + ${close_length}")
    string(SUBSTRING "${text}" ${from} -1 text)
    string(REGEX REPLACE "[\n\"]" " " inside "${inside}")
    string(APPEND plain "${before}\"${inside}\"")
  endwhile()
  string(APPEND plain "${text}")
  string(REPLACE "\\\"" "'" plain "${plain}")
  string(REPLACE "'\"'" "" plain "${plain}")
  string(REGEX REPLACE "\"[ \t\n]+\"" "" plain "${plain}")
  string(REGEX MATCHALL "\"[^\"\n]*\"" literals "${plain}")
  list(TRANSFORM literals REPLACE "^\"(.*)\"$" "\\1")
  set(${out} "${literals}" PARENT_SCOPE)
endfunction()

macro(refuse what line)
  message("${file}: a library ${what}: ${line}")
  math(EXPR bad "${bad} + 1")
endmacro()

file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/host/*.[ch]pp ${ROOT}/common/*.[ch]pp
  ${ROOT}/hal/*.[ch]pp ${ROOT}/firmware/*.[ch]pp)
list(FILTER files EXCLUDE REGEX "^host/(commands|programs)/")
foreach(file IN LISTS files)
  math(EXPR count "${count} + 1")
  # A bracket that is not closed, or a semicolon, would change where CMake's lists are divided.
  file(READ ${ROOT}/${file} text)
  string(REGEX REPLACE "[][]" " " text "${text}")
  string(REPLACE ";" "|" text "${text}")
  literals_of("${text}" literals)
  foreach(literal IN LISTS literals)
    if("${file}:${literal}" IN_LIST format_constants)
      continue()
    endif()
    # The parser of command lines offers these on behalf of every program.
    if(file MATCHES "^host/console/(program|completion|help)\\.cpp$")
      string(REGEX REPLACE "--(help|version)|^ ?--$" "" literal "${literal}")
    endif()
    if(literal MATCHES "--[a-zA-Z]|--$|(^|[ '(])-[a-zA-Z]([ ',.)=]|$)")
      refuse("names an option or a subcommand" "${literal}")
    endif()
    if(names AND literal MATCHES "(['`]|astrolabe )(${names})(['` ]|$)")
      refuse("names an option or a subcommand" "${literal}")
    elseif(long_names AND literal MATCHES "(^|[^a-z_])(${long_names})([^a-z_]|$)")
      refuse("names an option or a subcommand" "${literal}")
    endif()
    if(literal MATCHES "astrolabe")
      refuse("names the program" "${literal}")
    endif()
  endforeach()
  if(NOT file MATCHES "^host/console/")
    string(REGEX REPLACE "(^|\n)[ \t]*//[^\n]*" "\\1" text "${text}")
    string(REGEX MATCHALL "[^\n]*(std::(cout|cerr|clog)|fmt::print|[^a-z_](v?f?printf|dprintf|f?puts|f?putc|putchar|fwrite|perror|psignal|syslog) *\\(|write *\\( *(1|2|STD[A-Z]+_FILENO) *,)[^\n]*" prints
      "${text}")
    foreach(line IN LISTS prints)
      refuse("prints" "${line}")
    endforeach()
  endif()
endforeach()
if(count EQUAL 0)
  message(FATAL_ERROR "there is nothing to check in ${ROOT}: give the tree's absolute path")
endif()
if(bad GREATER 0)
  message(FATAL_ERROR "${bad} lines belong into host/commands")
endif()
message("${count} files name no command line")
