# The images for the Teensy, built beside this build by their own compiler: target teensy40_images.
# astro_uses_images(target): builds them first and tells the program where they are (ASTRO_IMAGE_DIR).
include_guard(GLOBAL)
# Several host builds of one tree share that folder: one at a time.
set(one_at_a_time flock ${CMAKE_SOURCE_DIR}/build/teensy40.lock)
add_custom_target(teensy40_images
  COMMAND ${one_at_a_time} ${CMAKE_COMMAND} --preset teensy40 -DASTROLABE_WERROR=${ASTROLABE_WERROR} > ${CMAKE_BINARY_DIR}/teensy40.log
  COMMAND ${one_at_a_time} ${CMAKE_COMMAND} --build ${CMAKE_SOURCE_DIR}/build/teensy40
  WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} VERBATIM USES_TERMINAL)

function(astro_uses_images target)
  add_dependencies(${target} teensy40_images)
  target_compile_definitions(${target} PRIVATE ASTRO_IMAGE_DIR="${CMAKE_SOURCE_DIR}/build/teensy40/bin")
endfunction()
