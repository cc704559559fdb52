# THE layer table: which part of the tree may use which. A line reads
#   layer : layers it may use besides itself
# A folder belongs to the longest layer that is a prefix of its path. The end of the configure step checks every link
# dependency against this table (AstroModule.cmake), the test "layers: every include keeps to the table" every #include
# line (check_includes.cmake).
set(ASTRO_LAYERS
  "common                       :"
  "hal/interface                : common"
  "hal/mock                     : common hal/interface"
  "hal/sim                      : common hal/interface"
  "hal/rp2040                   : common hal/interface hal/usb"
  "hal/i2c                      : hal/interface"
  "hal/teensy40                 : common hal/i2c hal/interface hal/usb"
  "hal/usb                      : common"
  "firmware/main                : common hal firmware"
  "firmware/app                 : common hal/interface"
  "host/base                    :"
  "host/calibration/end_poses   : host/base host/calibration/motion host/formats/tables"
  "host/calibration/gyro        : host/base host/calibration/motion"
  "host/calibration/judgement   : host/base host/calibration/end_poses host/calibration/likelihood host/calibration/motion host/calibration/preparation"
  "host/calibration/likelihood  : host/base host/calibration/motion host/calibration/preparation"
  "host/calibration/motion      : host/base"
  "host/calibration/preparation : host/base host/calibration/motion"
  "host/commands/base           : host/base host/console host/robot/port host/simulation/server"
  "host/commands/calibrate      : host/base host/calibration/end_poses host/calibration/gyro host/calibration/judgement host/calibration/likelihood host/calibration/motion host/calibration/preparation host/commands/base host/commands/shared host/console host/experiment/analysis host/experiment/files host/formats/tables host/import/drives host/import/scans host/lidar host/report"
  "host/commands/drive          : common host/base host/commands/base host/commands/shared host/console host/experiment/drive host/motor/bench host/motor/model host/recording host/report host/robot/client host/robot/motion"
  "host/commands/experiment     : host/base host/commands/base host/commands/shared host/commands/simulate host/console host/experiment/analysis host/experiment/drive host/experiment/files host/import/drives host/recording host/report host/robot/motion host/robot/parameters host/simulation/study host/truth/live host/truth/source host/wall"
  "host/commands/live           : host/base host/calibration/motion host/commands/base host/commands/shared host/console host/experiment/analysis host/formats/cdr host/formats/files host/formats/messages host/live/dashboard host/live/driver host/live/foxglove host/live/ros2 host/live/web host/page/robot host/recording host/robot/client host/truth/source"
  "host/commands/robot          : common host/base host/commands/base host/commands/shared host/console host/experiment/analysis host/formats/files host/import/drives host/recording host/robot/client host/robot/motion host/robot/parameters host/robot/port"
  "host/commands/selftest       : host/base host/commands/base host/commands/robot host/commands/shared host/console host/robot/port"
  "host/commands/shared         : common host/base host/commands/base host/console host/experiment/analysis host/experiment/drive host/experiment/files host/film/runs host/film/track host/formats/files host/formats/tables host/import/drives host/import/wheels host/recording host/robot/client host/robot/motion host/robot/parameters host/robot/port host/robot/sharing host/truth/files host/truth/floor host/truth/live host/truth/source"
  "host/commands/simulate       : host/base host/calibration/motion host/commands/base host/commands/shared host/console host/formats/cdr host/formats/messages host/live/dds host/simulation/room host/simulation/server host/simulation/study"
  "host/commands/truth          : host/base host/commands/base host/commands/shared host/console host/film/picture host/film/runs host/film/track host/import/drives host/import/scans host/import/wheels host/report host/truth/live"
  "host/console                 : host/base"
  "host/emulator/chip           : hal/sim hal/teensy40/registers host/emulator/core"
  "host/emulator/core           : hal/teensy40/registers host/base"
  "host/emulator/robot          : common hal/sim hal/teensy40/registers host/base host/emulator/chip host/emulator/core host/formats/files host/robot/port host/simulation/robot"
  "host/experiment/analysis     : common host/base host/calibration/end_poses host/calibration/gyro host/calibration/judgement host/calibration/likelihood host/calibration/motion host/calibration/preparation host/experiment/files host/lidar host/recording host/report host/robot/parameters"
  "host/experiment/drive        : host/base host/calibration/end_poses host/experiment/analysis host/experiment/files host/recording host/robot/client host/robot/motion host/robot/parameters host/truth/source"
  "host/experiment/files        : common host/base host/calibration/end_poses host/calibration/motion host/recording"
  "host/film/camera             : host/base host/film/picture"
  "host/film/picture            : host/base"
  "host/film/runs               : host/base host/calibration/likelihood host/experiment/analysis host/experiment/files host/film/camera host/film/picture host/film/track host/recording"
  "host/film/track              : host/base host/film/camera host/film/picture"
  "host/formats/cdr             : host/base"
  "host/formats/files           : host/base host/formats/cdr"
  "host/formats/messages        : host/base host/formats/cdr"
  "host/formats/tables         : host/base host/formats/files"
  "host/guides                  :"
  "host/import/bags             : common host/base host/calibration/motion host/formats/cdr host/formats/files host/formats/messages host/import/wheels"
  "host/import/drives           : common host/base host/calibration/end_poses host/calibration/motion host/experiment/analysis host/experiment/files host/formats/files host/formats/messages host/formats/tables host/import/bags host/import/wheels host/recording host/report host/truth/files host/truth/floor"
  "host/import/scans            : host/base host/calibration/motion host/experiment/analysis host/formats/cdr host/formats/files host/formats/messages host/formats/tables host/import/bags host/import/drives host/import/wheels host/lidar host/recording host/truth/scanners"
  "host/import/wheels           : common host/base host/formats/files host/formats/tables"
  "host/lidar                   : host/base host/calibration/motion"
  "host/live/dds                : host/base"
  "host/live/driver             : common host/base host/calibration/likelihood host/calibration/motion host/formats/cdr host/formats/messages host/recording host/robot/client host/robot/motion host/robot/parameters"
  "host/live/dashboard          : host/base host/live/web host/page/calls host/page/robot"
  "host/live/foxglove           : host/base host/formats/cdr host/formats/messages host/live/driver host/live/web"
  "host/live/web                : host/base"
  "host/live/ros2               : host/formats/cdr host/formats/messages host/live/dds host/live/driver"
  "host/motor/bench             : common host/base host/motor/model host/robot/motion host/robot/parameters"
  "host/motor/model             : common host/base"
  "host/programs/astrolabe      : common host/base host/commands host/console host/guides"
  "host/programs/emulator       : host/base host/commands/base host/console host/emulator/robot host/formats/files host/simulation/server"
  "host/python                  : common/protocol host/base host/calibration host/experiment host/import/drives host/import/wheels host/recording host/robot/client host/robot/motion host/robot/parameters host/simulation/robot host/simulation/study host/truth/files host/truth/floor"
  "host/recording               : common host/base host/formats/cdr host/formats/files host/formats/messages host/lidar"
  "host/report                  : host/base host/calibration/end_poses host/calibration/judgement host/motor/model host/recording"
  "host/robot/client            : common host/base host/robot/port host/robot/sharing"
  "host/robot/motion            : common host/base host/robot/client host/robot/parameters host/robot/sharing"
  "host/robot/parameters        : common host/base host/robot/client"
  "host/robot/port              : host/base"
  "host/robot/sharing           : common host/base host/robot/port"
  "host/simulation/robot        : firmware/app hal/sim host/base host/lidar host/recording host/robot/port host/simulation/room host/truth/source"
  "host/simulation/room         : host/base host/experiment/files"
  "host/simulation/server       : host/base host/recording host/simulation/robot host/simulation/room host/truth/scanners host/truth/source host/truth/trackers"
  "host/simulation/study        : host/base host/calibration/end_poses host/calibration/judgement host/calibration/likelihood host/calibration/motion host/experiment/analysis host/experiment/drive host/recording host/robot/motion host/robot/parameters host/simulation/robot"
  "host/truth/files             : host/base host/formats/tables host/truth/source"
  "host/truth/floor             : host/base host/calibration/motion host/recording host/truth/files"
  "host/truth/live              : host/base host/formats/cdr host/formats/messages host/lidar host/live/dds host/robot/port host/truth/scanners host/truth/source host/truth/trackers"
  "host/truth/scanners          : host/base host/formats/messages host/lidar"
  "host/truth/source            : host/base host/lidar host/recording"
  "host/truth/trackers          : host/base host/formats/cdr host/formats/messages host/truth/source"
  "host/wall                    : common host/base host/calibration/gyro host/calibration/judgement host/calibration/motion host/experiment/analysis host/experiment/files host/recording host/robot/client host/robot/motion host/robot/parameters"
  "host/page/calls              : host/base host/calibration/judgement host/experiment/analysis host/experiment/drive host/experiment/files host/formats/files host/formats/tables host/import/drives host/import/scans host/import/wheels host/lidar host/recording host/report host/robot/client host/simulation/robot host/truth/files host/truth/floor"
  "host/page/robot              : common host/base host/experiment/analysis host/experiment/drive host/experiment/files host/live/driver host/motor/bench host/motor/model host/page/calls host/recording host/robot/client host/robot/motion host/robot/parameters host/robot/sharing host/simulation/robot"
  "host/page/wasm               : host/base host/page/calls host/page/robot host/robot/client host/robot/port"
  "tests                        : common hal firmware host"
)

# Headers that would bring float, heap or the operating system into code that runs on the robot.
set(ASTRO_ON_ROBOT common hal/i2c hal/interface hal/rp2040 hal/teensy40 hal/usb firmware)
set(ASTRO_ON_ROBOT_FORBIDDEN
  cmath math.h complex random iostream fstream sstream cstdio stdio.h string vector map set list deque
  unordered_map unordered_set memory functional thread mutex future chrono filesystem new stdexcept)

# What rooms of host/ may include from outside the project. A line reads
#   headers : folders that may include them
# A header that ends with / stands for all in that folder. A header of the standard library that has no line here computes
# with values and is free for all; any other header needs a line. So what a room can do beyond values in, values out is
# read off here: host/calibration and host/motor/model are on no line but those of Eigen and fmt.
set(ASTRO_OUTSIDE
  "apriltag/                : host/film/picture"
  "CLI/                     : host/console"
  "Eigen/                   : host/base host/calibration host/lidar host/motor/model host/film host/simulation/study host/truth/files host/truth/floor host/wall"
  "boost/                   : host/base host/commands/live host/live/web host/robot/port host/robot/sharing"
  "cairo/                   : host/film/picture host/film/runs"
  "fastdds/ fastrtps/       : host/live/dds"
  "emscripten/ fast_float/  : host/page/wasm"
  "fmt/                     : host"
  "bzlib.h lz4frame.h zstd.h : host/formats/files"
  "openssl/                 : host/formats/cdr"
  "nlohmann/                : host/commands host/experiment host/import/drives host/live/dashboard host/live/foxglove host/page host/python host/report host/simulation/study host/wall"
  "pybind11/                : host/python/native"
  "sqlite3.h                : host/formats/files"
  "tinyxml2.h               : host/import/wheels"
  "toml++/                  : host/experiment host/simulation/room"
  "unicorn/ elf.h cxxabi.h  : host/emulator/core"
  "yaml.h                   : host/formats/files"
  "zlib.h                   : host/formats/files host/formats/tables"

  # The operating system.
  "asm/ sys/ fcntl.h poll.h signal.h spawn.h termios.h time.h unistd.h : host/base host/commands host/console host/programs host/recording host/robot/port host/robot/sharing host/simulation/server host/truth/live"
  "netinet/                 : host/base"
  "csignal                  : host/console"
  "chrono ctime             : host/base host/commands host/console host/emulator/robot host/experiment host/film host/formats host/import host/live host/page/wasm host/programs host/python host/recording host/robot host/simulation host/truth host/wall"
  "atomic condition_variable future mutex shared_mutex stop_token thread : host/base host/commands host/console host/live/dashboard host/live/dds host/live/foxglove host/live/web host/python/native host/robot/client host/robot/port host/robot/sharing host/simulation/server host/truth/live"

  # Files, and what is printed.
  "filesystem               : host/base host/commands host/console host/emulator host/experiment host/film host/formats host/import host/live/dashboard host/live/web host/page host/programs host/python host/recording host/report host/robot/port host/simulation/room host/simulation/server host/truth/files host/truth/live host/wall"
  "fstream                  : host/base host/emulator/core host/film/picture host/formats/files host/live/dashboard host/robot/port host/robot/sharing host/simulation/server"
  "iostream                 : host/commands"
  "cstdio                   : host/commands host/console host/programs"
)

# Sets `out` to TRUE if a file in folder `from` below host/ may include <header>.
function(astro_may_use_outside from header out)
  set(${out} TRUE PARENT_SCOPE)
  if(header MATCHES "[/.]")
    set(${out} FALSE PARENT_SCOPE)
  endif()
  foreach(line IN LISTS ASTRO_OUTSIDE)
    string(REGEX MATCH "^(.*[^ ]) *: *(.*)$" parsed "${line}")
    string(REPLACE " " ";" headers "${CMAKE_MATCH_1}")
    string(REPLACE " " ";" folders "${CMAKE_MATCH_2}")
    foreach(item IN LISTS headers)
      string(FIND "${header}" "${item}" at)
      if(header STREQUAL item OR (item MATCHES "/$" AND at EQUAL 0))
        set(${out} FALSE PARENT_SCOPE)
        foreach(folder IN LISTS folders)
          if("${from}/" MATCHES "^${folder}/")
            set(${out} TRUE PARENT_SCOPE)
          endif()
        endforeach()
        return()
      endif()
    endforeach()
  endforeach()
endfunction()

# Sets `out` to the layer that `path` (a folder or file below the root) belongs to, or to "".
function(astro_layer_of path out)
  set(best "")
  foreach(line IN LISTS ASTRO_LAYERS)
    string(REGEX MATCH "^[^: ]+" layer "${line}")
    if("${path}/" MATCHES "^${layer}/")
      string(LENGTH "${layer}" length)
      string(LENGTH "${best}" best_length)
      if(length GREATER best_length)
        set(best "${layer}")
      endif()
    endif()
  endforeach()
  set(${out} "${best}" PARENT_SCOPE)
endfunction()

# Sets `out` to TRUE if a file or target in folder `from` may use one in folder `to`.
function(astro_may_use from to out)
  set(${out} FALSE PARENT_SCOPE)
  astro_layer_of("${from}" layer)
  if(NOT layer STREQUAL "" AND "${to}/" MATCHES "^${layer}/")
    set(${out} TRUE PARENT_SCOPE)
    return()
  endif()
  foreach(line IN LISTS ASTRO_LAYERS)
    if(line MATCHES "^${layer} *: *(.*)$")
      string(REPLACE " " ";" allowed "${CMAKE_MATCH_1}")
      foreach(item IN LISTS allowed)
        if("${to}/" MATCHES "^${item}/")
          set(${out} TRUE PARENT_SCOPE)
        endif()
      endforeach()
    endif()
  endforeach()
endfunction()

# Stops with the names of the layers if some of them use one another in a circle.
function(astro_require_no_circle)
  set(names "")
  foreach(line IN LISTS ASTRO_LAYERS)
    string(REGEX MATCH "^[^: ]+" layer "${line}")
    list(APPEND names ${layer})
  endforeach()
  foreach(line IN LISTS ASTRO_LAYERS)
    string(REGEX MATCH "^([^: ]+) *: *(.*)$" parsed "${line}")
    set(layer ${CMAKE_MATCH_1})
    string(REPLACE " " ";" items "${CMAKE_MATCH_2}")
    set(uses_${layer} "")
    foreach(item IN LISTS items)
      foreach(name IN LISTS names)  # a folder stands for the layers inside it
        if("${name}/" MATCHES "^${item}/" AND NOT name STREQUAL layer)
          list(APPEND uses_${layer} ${name})
        endif()
      endforeach()
    endforeach()
  endforeach()
  # A layer that uses none of those that are left, or that none of them uses, goes: a circle is what stays.
  set(going TRUE)
  while(going)
    set(going FALSE)
    foreach(layer IN LISTS names)
      set(uses FALSE)
      set(used FALSE)
      foreach(other IN LISTS names)
        if(other IN_LIST uses_${layer})
          set(uses TRUE)
        endif()
        if(layer IN_LIST uses_${other})
          set(used TRUE)
        endif()
      endforeach()
      if(NOT uses OR NOT used)
        list(REMOVE_ITEM names ${layer})
        set(going TRUE)
      endif()
    endforeach()
  endwhile()
  if(names)
    list(JOIN names ", " circle)
    message(FATAL_ERROR "the layer table goes in a circle: ${circle}")
  endif()
endfunction()
