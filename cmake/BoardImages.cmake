# astro_board_images(board): the images for a board, built beside this build by their own compiler: target <board>_images.
# The folder with them is build/<board>/bin.
include_guard(GLOBAL)
function(astro_board_images board)
  if(TARGET ${board}_images)
    return()
  endif()
  # Several host builds of one tree share that folder: one at a time.
  set(one_at_a_time flock ${CMAKE_SOURCE_DIR}/build/${board}.lock)
  add_custom_target(${board}_images
    COMMAND ${one_at_a_time} ${CMAKE_COMMAND} --preset ${board} -DASTROLABE_WERROR=${ASTROLABE_WERROR} > ${CMAKE_BINARY_DIR}/${board}.log
    COMMAND ${one_at_a_time} ${CMAKE_COMMAND} --build ${CMAKE_SOURCE_DIR}/build/${board}
    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} VERBATIM USES_TERMINAL)
endfunction()
