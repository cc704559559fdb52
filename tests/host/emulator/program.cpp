#include "tests/host/emulator/program.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "host/emulator/core/register_names.hpp"

namespace astro::emulator {
namespace {

constexpr std::string_view kMacros = R"(
.syntax unified
.cpu cortex-m7
.fpu fpv5-d16
.thumb
.macro set register, value
  ldr r6, =\register
  ldr r7, =\value
  str r7, [r6]
.endm
.macro set16 register, value
  ldr r6, =\register
  ldr r7, =\value
  strh r7, [r6]
.endm
.macro get register
  ldr r6, =\register
  ldr r0, [r6]
.endm
.macro get16 register
  ldr r6, =\register
  ldrh r0, [r6]
.endm
.macro until register, mask, value
  1000: get \register
    ldr r1, =\mask
    ands r0, r1
    ldr r1, =\value
    cmp r0, r1
    bne 1000b
.endm
.macro pause us
  ldr r0, =\us * 300
  1001: subs r0, #1
    bne 1001b
.endm
.macro keep n
  ldr r6, =0x20000000
  str r0, [r6, #4*\n]
.endm
.macro count n
  ldr r6, =0x20000000
  ldr r0, [r6, #4*\n]
  adds r0, #1
  str r0, [r6, #4*\n]
.endm
.macro stay
  b .
.endm
.macro handler n
  .ltorg
  .global exception_\n
  .thumb_func
  exception_\n:
.endm
)";

/// Header of the image, start-up, and a vector table whose entries a program replaces by name.
std::string frame() {
  std::string text(kMacros);
  text += R"(
  .text
  .word 0x42464346, 0x56010000
  .org 0x50, 0xFF
  .word 0x00200000
  .org 0x1000, 0xFF
  .word 0x432000D1, reset, 0, 0, 0x60001020, 0x60001000, 0, 0
  .word 0x60000000, 0x00003000, 0, 0
  .global reset
  .thumb_func
reset:
  set 0x400AC044, 0xAAAAAAFF
  set 0x400AC040, 0x00200007
  set 0x400AC038, 0x00AA0000
  ldr r0, =0x20060000
  mov sp, r0
  set 0xE000ED08, vectors
  movs r0, #0
  b main
  .thumb_func
unexpected:
  mrs r0, ipsr
  keep 15
  stay
  .ltorg
  .org 0x2000, 0xFF
vectors:
  .word 0x20060000, reset
)";
  for (int n = 2; n < 16 + 160; ++n)
    text += fmt::format(
        "  .weak exception_{0}\n  .thumb_set exception_{0}, unexpected\n  .word exception_{0}\n", n);
  return text;
}

std::string program(const std::string& code) {
  std::string text(kMacros);
  for (const RegisterRow& row : registers())
    text += fmt::format(".equ {}_{}, 0x{:08X}\n", row.instance, row.name, row.address);
  return text + "  .text\n  .global main\n  .thumb_func\nmain:\n" + code + "\n  stay\n";
}

void run(const std::string& command) {
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
}

}  // namespace

std::string in_ram(const std::string& code) {
  return R"(
    ldr r0, =begin
    ldr r1, =end
    movs r2, #0x400 >> 8
    lsls r2, #8
  1: ldr r3, [r0], #4
    str r3, [r2], #4
    cmp r0, r1
    blo 1b
    ldr r3, =0x401
    bx r3
    .ltorg
    .balign 4
begin:
)" + code +
         R"(
    stay
    .ltorg
    .balign 4
end:
)";
}

Program::Program(const std::string& code) {
  const std::string at = folder_.path() / "";
  std::ofstream(at + "frame.s") << frame();
  std::ofstream(at + "program.s") << program(code);
  for (const char* part : {"frame", "program"})
    run(fmt::format("arm-none-eabi-as -o {0}{1}.o {0}{1}.s", at, part));
  run(fmt::format("arm-none-eabi-ld -Ttext=0x60000000 -e reset -o {0}program.elf {0}frame.o {0}program.o",
                  at));
  run(fmt::format("arm-none-eabi-objcopy -O ihex {0}program.elf {0}program.hex", at));
  teensy_ = std::make_unique<Teensy>(hex(), sim::Config{}, HandOver::tidy);
}

Remark Program::fault(std::chrono::nanoseconds limit) {
  return support::told_by([&] { teensy_->run_for(limit); });
}

}  // namespace astro::emulator
