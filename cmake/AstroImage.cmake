# astro_image(name SOURCES ... DEPENDS ...): a program for the robot's processor, in build/<preset>/bin as
#   name.elf, name.hex (what is flashed), name.map and name.size.txt (what it takes, by section). Relocations stay in
#   the .elf, so that tests/target/image sees whose address is taken.
include(AstroModule)

function(astro_image name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;DEPENDS")
  set(script ${CMAKE_SOURCE_DIR}/hal/teensy40/core/teensy40.ld)
  set(file ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${name})
  astro_program(${name} SOURCES ${arg_SOURCES} DEPENDS ${arg_DEPENDS} hal.teensy40)
  set_target_properties(${name} PROPERTIES SUFFIX .elf LINK_DEPENDS ${script})
  target_link_options(${name} PRIVATE -nostartfiles --specs=nano.specs -T ${script}
    -Wl,--gc-sections -Wl,--fatal-warnings -Wl,--emit-relocs -Wl,-Map=${file}.map)
  add_custom_command(TARGET ${name} POST_BUILD BYPRODUCTS ${file}.hex ${file}.size.txt
    COMMAND arm-none-eabi-objcopy -O ihex ${file}.elf ${file}.hex
    COMMAND arm-none-eabi-size -A -x ${file}.elf > ${file}.size.txt)
endfunction()
