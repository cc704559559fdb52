include_guard(GLOBAL)
# The images for the Teensy, built beside this build by their own compiler: target teensy40_images.
# astro_uses_images(target): builds them first and tells the program where they are (ASTRO_IMAGE_DIR).
set(ASTRO_IMAGE_FOLDER ${CMAKE_SOURCE_DIR}/build/teensy40 CACHE INTERNAL "")
add_custom_target(teensy40_images ALL
  COMMAND ${CMAKE_COMMAND} --preset teensy40 > ${CMAKE_BINARY_DIR}/teensy40.log
  COMMAND ${CMAKE_COMMAND} --build ${ASTRO_IMAGE_FOLDER}
  WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} VERBATIM USES_TERMINAL)

function(astro_uses_images target)
  add_dependencies(${target} teensy40_images)
  target_compile_definitions(${target} PRIVATE ASTRO_IMAGE_DIR="${ASTRO_IMAGE_FOLDER}/bin")
endfunction()
