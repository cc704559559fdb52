# THE layer table: which part of the tree may use which. A line reads
#   layer : layers it may use
# A folder belongs to the longest layer that is a prefix of its path. The configure step holds link edges
# to this table (AstroModule.cmake) and the test `layers.includes` holds #include lines to it
# (check_includes.cmake).
set(ASTRO_LAYERS
  "common         : common"
  "hal/interface  : common hal/interface"
  "hal/mock       : common hal/interface hal/mock"
  "hal/sim        : common hal/interface hal/sim"
  "hal/teensy40   : common hal/interface hal/teensy40"
  "firmware/main  : common hal firmware"
  "firmware/app   : common hal/interface firmware/app"
  "host/base : host/base"
  "host/calibration/clock : host/calibration/clock host/calibration/motion"
  "host/calibration/end_poses : host/base host/calibration/end_poses host/calibration/motion"
  "host/calibration/judgement : host/base host/calibration/end_poses host/calibration/judgement host/calibration/likelihood host/calibration/motion host/calibration/preparation"
  "host/calibration/likelihood : host/base host/calibration/likelihood host/calibration/motion host/calibration/preparation"
  "host/calibration/motion : host/calibration/motion"
  "host/calibration/preparation : host/base host/calibration/clock host/calibration/motion host/calibration/preparation"
  "host/commands/base : host/base host/commands/base host/console"
  "host/commands/calibrate : host/base host/calibration/end_poses host/commands/base host/commands/calibrate host/commands/shared host/commands/simulate host/console host/experiment/analysis host/experiment/drive host/experiment/files host/recording/files host/report host/robot/motion host/robot/parameters host/simulation/study"
  "host/commands/drive : host/base host/commands/base host/commands/drive host/commands/shared host/console host/experiment/drive host/recording/run host/robot/client host/robot/motion"
  "host/commands/robot : common/protocol common/safety host/base host/commands/base host/commands/robot host/commands/shared host/console host/experiment/analysis host/experiment/drive host/robot/client host/robot/motion host/robot/parameters host/robot/port"
  "host/commands/serving : host/base host/commands/serving host/console host/robot/port host/simulation/server"
  "host/commands/shared : common/protocol common/safety host/base host/commands/base host/commands/shared host/console host/experiment/analysis host/experiment/drive host/experiment/files host/recording/files host/recording/run host/robot/client host/robot/motion host/robot/parameters host/robot/port host/robot/sharing host/truth/files host/truth/live host/truth/manual host/truth/source"
  "host/commands/simulate : host/base host/calibration/motion host/commands/base host/commands/serving host/commands/shared host/commands/simulate host/console host/simulation/study"
  "host/commands/tune : host/base host/commands/base host/commands/shared host/commands/tune host/console host/experiment/drive host/motor/bench host/motor/model host/motor/wiring host/report host/robot/parameters"
  "host/console : host/base host/console"
  "host/emulator/chip : hal/sim hal/teensy40/registers host/emulator/chip host/emulator/core"
  "host/emulator/core : hal/teensy40/registers host/base host/emulator/core"
  "host/emulator/robot : hal/sim hal/teensy40/registers host/base host/emulator/chip host/emulator/core host/emulator/robot host/emulator/usb host/robot/port host/simulation/robot host/truth/source"
  "host/emulator/usb : hal/teensy40/registers host/base host/emulator/chip host/emulator/core host/emulator/usb"
  "host/experiment/analysis : common/params host/base host/calibration/end_poses host/calibration/judgement host/calibration/likelihood host/calibration/motion host/experiment/analysis host/experiment/files host/recording/files host/recording/run host/report host/robot/parameters"
  "host/experiment/drive : host/base host/calibration/end_poses host/experiment/analysis host/experiment/drive host/experiment/files host/recording/files host/recording/run host/robot/motion host/robot/parameters host/truth/source"
  "host/experiment/files : common/protocol host/base host/calibration/end_poses host/calibration/motion host/experiment/files host/recording/files host/recording/run"
  "host/motor/bench : host/base host/motor/bench host/motor/model host/motor/wiring host/robot/motion host/robot/parameters"
  "host/motor/model : host/base host/motor/model"
  "host/motor/wiring : host/base host/motor/model host/motor/wiring"
  "host/programs/astrolabe : common/base host/base host/commands/base host/commands/calibrate host/commands/drive host/commands/robot host/commands/shared host/commands/simulate host/commands/tune host/console host/programs/astrolabe"
  "host/programs/emulator : host/base host/commands/base host/commands/serving host/console host/emulator/robot host/programs/emulator host/simulation/server"
  "host/recording/files : host/base host/recording/files host/recording/mcap host/recording/run host/ros2"
  "host/recording/mcap : host/base host/recording/mcap"
  "host/recording/run : host/base host/recording/mcap host/recording/run"
  "host/report : host/base host/calibration/end_poses host/calibration/judgement host/motor/model host/recording/run host/report"
  "host/robot/client : common/protocol common/safety host/base host/robot/client host/robot/port host/robot/sharing"
  "host/robot/motion : common/protocol common/safety host/base host/robot/client host/robot/motion host/robot/parameters host/robot/sharing"
  "host/robot/parameters : common/protocol host/base host/robot/client host/robot/parameters"
  "host/robot/port : host/base host/robot/port"
  "host/robot/sharing : common/base common/protocol host/base host/robot/port host/robot/sharing"
  "host/ros2 : host/base host/recording/run host/ros2"
  "host/simulation/robot : firmware/app hal/sim host/recording/run host/robot/port host/simulation/robot host/truth/source"
  "host/simulation/server : host/base host/recording/run host/simulation/robot host/simulation/server"
  "host/simulation/study : host/base host/calibration/end_poses host/calibration/judgement host/calibration/likelihood host/calibration/motion host/experiment/analysis host/experiment/drive host/recording/run host/robot/parameters host/simulation/robot host/simulation/study"
  "host/truth/files : host/base host/truth/files host/truth/manual host/truth/source"
  "host/truth/live : host/base host/truth/live host/truth/source"
  "host/truth/manual : host/base host/recording/run host/truth/manual host/truth/source"
  "host/truth/source : host/base host/recording/run host/truth/source"
  "tests          : common hal firmware host tests"
)

# Headers that would bring float, heap or the operating system into code that runs on the robot.
set(ASTRO_ON_ROBOT common hal/interface hal/teensy40 firmware)
set(ASTRO_ON_ROBOT_FORBIDDEN
  cmath math.h complex random iostream fstream sstream cstdio stdio.h string vector map set list deque
  unordered_map unordered_set memory functional thread mutex future chrono filesystem new stdexcept)

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
