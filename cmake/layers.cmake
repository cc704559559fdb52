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
  "hal/teensy40                 : common hal/interface"
  "firmware/main                : common hal firmware"
  "firmware/app                 : common hal/interface"
  "host/base                    :"
  "host/calibration/clock       : host/calibration/motion"
  "host/calibration/end_poses   : host/base host/calibration/motion"
  "host/calibration/judgement   : host/base host/calibration/end_poses host/calibration/likelihood host/calibration/motion host/calibration/preparation"
  "host/calibration/likelihood  : host/base host/calibration/motion host/calibration/preparation"
  "host/calibration/motion      :"
  "host/calibration/preparation : host/base host/calibration/clock host/calibration/motion"
  "host/calibration/wall        : host/base host/calibration/judgement host/calibration/motion"
  "host/commands/base           : host/base host/console"
  "host/commands/calibrate      : host/base host/calibration/end_poses host/calibration/motion host/commands/base host/commands/shared host/console host/experiment/analysis host/experiment/files host/recording/files"
  "host/commands/drive          : common host/base host/commands/base host/commands/shared host/console host/experiment/drive host/recording/run host/robot"
  "host/commands/experiment     : host/base host/calibration/wall host/commands/base host/commands/shared host/commands/simulate host/console host/experiment host/recording/files host/report/sections host/robot host/simulation/study host/truth/manual"
  "host/commands/robot          : common host/base host/commands/base host/commands/shared host/console host/experiment host/recording/run host/robot"
  "host/commands/ros2           : host/base host/calibration/likelihood host/calibration/motion host/commands/base host/commands/shared host/console host/experiment/analysis host/recording/yaml host/ros2 host/truth/source"
  "host/commands/serving        : host/base host/commands/base host/console host/robot/port host/simulation/server"
  "host/commands/shared         : common host/base host/calibration/end_poses host/commands/base host/console host/experiment host/recording host/robot host/truth"
  "host/commands/simulate       : host/base host/calibration/motion host/commands/base host/commands/serving host/commands/shared host/console host/ros2/dds host/ros2/types host/simulation/ros2 host/simulation/study"
  "host/commands/truth          : host/base host/commands/base host/commands/shared host/console host/experiment/import host/report host/truth/film host/truth/live host/truth/tags"
  "host/commands/tune           : host/base host/commands/base host/commands/shared host/console host/experiment/drive host/motor host/report host/robot/client host/robot/parameters"
  "host/console                 : host/base"
  "host/emulator/chip           : hal/sim hal/teensy40/registers host/emulator/core"
  "host/emulator/core           : hal/teensy40/registers host/base"
  "host/emulator/robot          : common hal/sim hal/teensy40/registers host/base host/emulator/chip host/emulator/core host/emulator/usb host/robot/port host/simulation/robot"
  "host/emulator/usb            : hal/teensy40/registers host/base host/emulator/chip host/emulator/core"
  "host/experiment/analysis     : common host/base host/calibration host/experiment/files host/recording host/report/sections host/robot/parameters"
  "host/experiment/drive        : host/base host/calibration/end_poses host/experiment/analysis host/experiment/files host/recording host/robot host/truth/source"
  "host/experiment/files        : common host/base host/calibration host/recording"
  "host/experiment/film         : host/base host/calibration/likelihood host/experiment/analysis host/experiment/files host/recording/run host/truth/film"
  "host/experiment/import       : common host/base host/calibration/motion host/experiment/analysis host/experiment/files host/recording host/report/sections host/ros2/recorded host/truth/bags host/truth/files host/truth/floor"
  "host/experiment/wall         : common host/base host/calibration/motion host/calibration/wall host/experiment/analysis host/experiment/files host/robot"
  "host/motor/bench             : common host/base host/motor/model host/motor/wiring host/robot"
  "host/motor/model             : host/base"
  "host/motor/wiring            : host/base host/motor/model"
  "host/programs/astrolabe      : common host/base host/commands host/console"
  "host/programs/emulator       : host/base host/commands/base host/commands/serving host/console host/emulator/robot host/simulation/server"
  "host/recording/bag           : host/base host/recording/mcap host/recording/yaml"
  "host/recording/files         : common host/base host/recording/bag host/recording/mcap host/recording/run host/ros2/recorded"
  "host/recording/mcap          : host/base"
  "host/recording/foreign       : host/base host/recording/bag host/recording/yaml host/ros2/recorded"
  "host/recording/run           : common host/base host/recording/mcap"
  "host/recording/yaml          : host/base"
  "host/report/page             : host/base"
  "host/report/sections         : host/base host/calibration host/motor/model host/recording/run host/report/page"
  "host/robot/arbitration       : common host/base"
  "host/robot/client            : common host/base host/robot/arbitration host/robot/port host/robot/sharing"
  "host/robot/motion            : common host/base host/robot/arbitration host/robot/client host/robot/parameters host/robot/sharing"
  "host/robot/parameters        : common host/base host/robot/client"
  "host/robot/port              : host/base"
  "host/robot/sharing           : common host/base host/robot/arbitration host/robot/port"
  "host/ros2/cdr                : host/base"
  "host/ros2/dds                : host/base"
  "host/ros2/driver             : common host/base host/calibration/likelihood host/calibration/motion host/recording/run host/robot host/ros2/cdr host/ros2/messages host/ros2/middleware host/ros2/odometry host/ros2/recorded host/ros2/types"
  "host/ros2/foxglove           : host/base host/ros2/cdr host/ros2/messages host/ros2/middleware host/ros2/types"
  "host/ros2/messages           : host/base host/ros2/cdr"
  "host/ros2/middleware         : host/base host/ros2/messages host/ros2/types"
  "host/ros2/node               : host/base host/ros2/cdr host/ros2/dds host/ros2/messages host/ros2/middleware host/ros2/types"
  "host/ros2/odometry           : common host/base host/calibration/likelihood host/calibration/motion host/recording/run"
  "host/ros2/recorded           : host/base host/recording/run host/ros2/cdr host/ros2/messages host/ros2/types"
  "host/ros2/types              : host/base host/ros2/cdr"
  "host/simulation/robot        : firmware/app hal/sim host/recording/run host/robot/port host/truth/source"
  "host/simulation/ros2         : host/base host/ros2/cdr host/ros2/dds host/ros2/messages host/ros2/types host/simulation/tracker host/truth/source"
  "host/simulation/server       : host/base host/recording/run host/simulation/robot host/simulation/tracker"
  "host/simulation/study        : host/base host/calibration host/experiment host/recording/run host/robot/motion host/robot/parameters host/simulation/robot"
  "host/simulation/tracker      : host/base host/recording/run host/truth/natnet host/truth/source host/truth/vrpn"
  "host/truth/bags              : host/base host/recording/foreign host/truth/files host/truth/source"
  "host/truth/files             : host/base host/truth/manual host/truth/source"
  "host/truth/film/camera       : host/truth/film/tags"
  "host/truth/film/preview      : host/truth/film/camera host/truth/film/track host/truth/film/video"
  "host/truth/film/tags         : host/base host/truth/film/video"
  "host/truth/film/track        : host/base host/truth/film/camera host/truth/film/tags host/truth/film/video"
  "host/truth/film/video        : host/base"
  "host/truth/floor             : host/base host/calibration/clock host/calibration/motion host/recording/run host/truth/files host/truth/source"
  "host/truth/live              : host/base host/ros2/dds host/ros2/recorded host/ros2/types host/truth/natnet host/truth/ros2 host/truth/source host/truth/vrpn"
  "host/truth/manual            : host/base host/recording/run host/truth/source"
  "host/truth/natnet            : host/base host/truth/source"
  "host/truth/ros2              : host/base host/ros2/cdr host/ros2/messages host/ros2/recorded host/truth/source"
  "host/truth/source            : host/base host/recording/run"
  "host/truth/tags              : host/base"
  "host/truth/vrpn              : host/base host/truth/source"
  "tests                        : common hal firmware host"
)

# Headers that would bring float, heap or the operating system into code that runs on the robot.
set(ASTRO_ON_ROBOT common hal/interface hal/teensy40 firmware)
set(ASTRO_ON_ROBOT_FORBIDDEN
  cmath math.h complex random iostream fstream sstream cstdio stdio.h string vector map set list deque
  unordered_map unordered_set memory functional thread mutex future chrono filesystem new stdexcept)

# What rooms of host/ may include from outside the project. A line reads
#   headers : folders that may include them
# A header that ends with / stands for all in that folder. A header of the standard library that has no line here computes
# with values and is free for all; any other header needs a line. So what a room can do beyond values in, values out is
# read off here: host/calibration, host/motor/model and host/robot/arbitration are on no line but those of Eigen and fmt.
set(ASTRO_OUTSIDE
  "apriltag/                : host/truth/film/tags host/truth/tags"
  "CLI/                     : host/console"
  "Eigen/                   : host/calibration host/motor/model host/simulation/study host/truth/film host/truth/floor"
  "boost/                   : host/robot/port host/robot/sharing host/ros2/foxglove"
  "cairo/                   : host/truth/tags"
  "fastdds/ fastrtps/       : host/ros2/dds"
  "fmt/                     : host"
  "lz4frame.h zstd.h        : host/recording/mcap"
  "openssl/                 : host/ros2/types"
  "nlohmann/                : host/commands host/experiment host/report host/ros2/foxglove host/simulation/study"
  "sqlite3.h                : host/recording/bag"
  "tinyxml2.h               : host/recording/foreign"
  "toml++/                  : host/experiment"
  "unicorn/ elf.h cxxabi.h  : host/emulator/core"
  "yaml.h                   : host/recording/yaml"
  "zlib.h                   : host/recording/mcap host/truth/film/preview host/truth/files"

  # The operating system.
  "asm/ sys/ fcntl.h poll.h signal.h spawn.h termios.h time.h unistd.h : host/base host/commands host/console host/programs host/recording/files host/robot/port host/robot/sharing host/simulation/server host/truth/film/video host/truth/live"
  "arpa/ netinet/ netdb.h   : host/base/net"
  "csignal                  : host/console"
  "chrono ctime             : host/base host/commands host/console host/emulator/robot host/experiment host/recording/files host/robot host/ros2 host/simulation host/truth"
  "atomic condition_variable future mutex shared_mutex stop_token thread : host/commands host/console host/robot/client host/robot/port host/robot/sharing host/ros2/dds host/ros2/foxglove host/simulation/server host/simulation/study host/truth/live"

  # Files, and what is printed.
  "filesystem               : host/base host/commands host/console host/emulator host/experiment host/programs host/recording/bag host/recording/files host/recording/foreign host/report host/robot/port host/simulation/server host/truth/bags host/truth/film host/truth/files host/truth/live"
  "fstream                  : host/base host/emulator/core host/truth/film/video host/recording/bag host/robot/port host/robot/sharing host/simulation/server"
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
