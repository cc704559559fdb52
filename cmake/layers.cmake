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
  "host/base      : host/base"
  "host/calibration : common host/base host/calibration"
  "host/study     : common host/base host/calibration host/study"
  "host/recording : host/base host/recording"
  "host/link      : common host/base host/link"
  "host/truth     : host/base host/recording host/truth"
  "host/identification : host/base host/identification"
  "host/tuning    : common host/base host/link host/identification host/tuning"
  "host/report    : host/base host/calibration host/identification host/recording host/report"
  "host/experiment : common host/base host/calibration host/link host/recording host/report host/truth host/experiment"
  "host/simulator : common hal/interface hal/sim firmware/app host/base host/link host/truth host/recording host/simulator"
  "host/simulated_study : host/base host/calibration host/experiment host/link host/recording host/simulator host/study host/simulated_study"
  "host/emulator  : common hal/interface hal/sim hal/teensy40/registers host/base host/link host/recording host/simulator host/truth host/emulator"
  "host/emulator/program : common hal/sim host/base host/cli host/emulator host/link host/recording host/simulator"
  "host/cli       : common host/base host/calibration host/experiment host/identification host/link host/recording host/report host/simulated_study host/simulator host/study host/truth host/tuning host/cli"
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
