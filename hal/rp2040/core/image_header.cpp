#include <array>
#include <cstdint>

#include "common/base/version.hpp"
#include "hal/rp2040/core/start.hpp"

/// What lies at fixed places of the flash: the second stage of the boot, which the ROM runs, the vectors of the first
/// instructions, and the name of the image. The linker script puts each block at its place.
namespace astro::rp2040 {
namespace {

struct ImageInfo {
  std::array<char, 12> name{"Astrolabe"};
  Version version = kFirmwareVersion;
  std::uint8_t bytes = 32;  // of this record
  std::array<char, 16> board{"rp2040"};
};
static_assert(sizeof(ImageInfo) == 32);

struct Vectors {
  const void* stack;
  void (*entries[15])();
};
static_assert(sizeof(void*) != 4 || sizeof(Vectors) == 64);

}  // namespace

extern "C" {

extern const std::uint8_t stack_top;

/// The ROM copies these 252 bytes to the end of the SRAM, checks their sum and calls them with the flash unreadable.
///
/// Sets up the mapping so that a read of the processor becomes the command 03h, 24 bits of address and 32 bits of data on
/// one line, at a quarter of the system clock: 31 MHz later, of the 50 MHz that this command allows on any flash. Then
/// starts the program by its own vectors. Every flash of this class has 03h, needs no mode and no dummy clocks for it, and
/// understands other commands at any time.
[[gnu::naked, gnu::used, gnu::section(".second_stage")]] void second_stage() {
  asm volatile(
      "ldr r3, =0x18000000\n"  // XIP_SSI
      "movs r0, #0\n"
      "str r0, [r3, #0x08]\n"  // SSIENR: off, so that it can be set
      "movs r0, #4\n"
      "str r0, [r3, #0x14]\n"  // BAUDR
      "movs r0, #0\n"
      "str r0, [r3, #0x04]\n"  // CTRLR1: one word a read
      "ldr r0, =0x001F0300\n"  // CTRLR0: 32 bits a word, one line, "EEPROM read"
      "str r0, [r3]\n"
      "ldr r0, =0x03000218\n"  // SPI_CTRLR0: command 03h of 8 bits, address of 24 bits
      "movs r1, #0xF4\n"
      "str r0, [r3, r1]\n"
      "movs r0, #1\n"
      "str r0, [r3, #0x10]\n"  // SER: the one chip select
      "str r0, [r3, #0x08]\n"  // SSIENR
      "ldr r0, =0x10000100\n"
      "ldr r1, =0xE000ED08\n"  // VTOR
      "str r0, [r1]\n"
      "ldr r1, [r0]\n"
      "mov sp, r1\n"
      "ldr r0, [r0, #4]\n"
      "bx r0\n"
      ".ltorg\n");
}

/// Until the program has its own, every exception starts it again.
[[gnu::section(".image_vectors")]] extern const Vectors image_vectors;
[[gnu::used]] const Vectors image_vectors{&stack_top,
                                          {reset, reset, reset, reset, reset, reset, reset, reset, reset,
                                           reset, reset, reset, reset, reset, reset}};

/// Identifies the image to programs that flash it (host/formats/files/firmware_image).
[[gnu::section(".image_info")]] extern const ImageInfo image_info;
[[gnu::used]] const ImageInfo image_info{};

}  // extern "C"

}  // namespace astro::rp2040
