# astro_image(name SOURCES ... DEPENDS ...): a program for the robot's processor, in build/<preset>/bin as
#   name.elf, name.hex or name.uf2 (what is flashed: a Teensy takes Intel HEX, an RP2040 takes UF2), name.map and
#   name.size.txt (what it takes, by section). Relocations stay in the .elf, so that tests/target/image sees whose address is
#   taken.
# The board is ASTROLABE_TARGET; its linker script is hal/<board>/core/<board>.ld.
include(AstroModule)

# What makes a .uf2, and completes the .elf with the check sum that the boot ROM wants. It runs here, not on the robot.
if(ASTROLABE_TARGET STREQUAL rp2040 AND NOT TARGET astro_write_uf2)
  find_program(ASTROLABE_HOST_CXX NAMES g++ c++ REQUIRED)
  set(source ${CMAKE_SOURCE_DIR}/cmake/uf2/write_uf2.cpp)
  set(astro_uf2_program ${CMAKE_BINARY_DIR}/write_uf2)
  add_custom_command(OUTPUT ${astro_uf2_program} DEPENDS ${source}
    COMMAND ${ASTROLABE_HOST_CXX} -std=c++20 -O1 -Wall -Wextra -Werror ${source} -o ${astro_uf2_program})
  add_custom_target(astro_write_uf2 DEPENDS ${astro_uf2_program})
endif()

function(astro_image name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;DEPENDS")
  set(script ${CMAKE_SOURCE_DIR}/hal/${ASTROLABE_TARGET}/core/${ASTROLABE_TARGET}.ld)
  set(file ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${name})
  astro_program(${name} SOURCES ${arg_SOURCES} DEPENDS ${arg_DEPENDS} hal.${ASTROLABE_TARGET})
  set_target_properties(${name} PROPERTIES SUFFIX .elf LINK_DEPENDS ${script})
  target_link_options(${name} PRIVATE -nostartfiles --specs=nano.specs -T ${script}
    -Wl,--gc-sections -Wl,--fatal-warnings -Wl,--emit-relocs -Wl,-Map=${file}.map)
  if(ASTROLABE_TARGET STREQUAL rp2040)
    add_dependencies(${name} astro_write_uf2)
    add_custom_command(TARGET ${name} POST_BUILD BYPRODUCTS ${file}.bin ${file}.stage.bin ${file}.uf2
      COMMAND arm-none-eabi-objcopy -O binary ${file}.elf ${file}.bin
      COMMAND ${CMAKE_BINARY_DIR}/write_uf2 ${file}.bin ${file}.stage.bin ${file}.uf2
      COMMAND arm-none-eabi-objcopy --update-section .second_stage=${file}.stage.bin ${file}.elf)
  else()
    add_custom_command(TARGET ${name} POST_BUILD BYPRODUCTS ${file}.hex
      COMMAND arm-none-eabi-objcopy -O ihex ${file}.elf ${file}.hex)
  endif()
  add_custom_command(TARGET ${name} POST_BUILD BYPRODUCTS ${file}.size.txt
    COMMAND arm-none-eabi-size -A -x ${file}.elf > ${file}.size.txt)
endfunction()
