# astro_uses_images(target): builds the images for the Teensy first and tells the program where they are (ASTRO_IMAGE_DIR).
include_guard(GLOBAL)
include(BoardImages)
astro_board_images(teensy40)

function(astro_uses_images target)
  add_dependencies(${target} teensy40_images)
  target_compile_definitions(${target} PRIVATE ASTRO_IMAGE_DIR="${CMAKE_SOURCE_DIR}/build/teensy40/bin")
endfunction()
