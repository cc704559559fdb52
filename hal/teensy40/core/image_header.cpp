#include <array>
#include <cstdint>

#include "common/base/version.hpp"
#include "hal/teensy40/core/start.hpp"

/// The data that the boot ROM reads before it runs the program: how to access the flash, and where the
/// program is. The linker script puts each block at its place.
namespace astro::teensy40 {
namespace {

/// FlexSPI configuration block at 0x60000000, by word: the values of every Teensy 4.0.
struct FlashConfiguration {
  std::uint32_t tag = 0x42464346;      // "FCFB"
  std::uint32_t version = 0x56010000;  // 1.0.0
  std::uint32_t reserved_08 = 0;
  std::uint32_t sampling = 0x00020101;  // sampled by the DQS pad's loop; chip select 1 clock held, 2 set up
  std::array<std::uint32_t, 13> reserved_10{};
  std::uint32_t device = 0x01060401;  // serial NOR, 4 data lines, 100 MHz
  std::array<std::uint32_t, 2> reserved_48{};
  std::uint32_t size_bytes = 0x0020'0000;
  std::array<std::uint32_t, 11> reserved_54{};
  // Read 0xEB: address and mode 0xFF on four lines, 4 clocks, data on four lines. The mode keeps the flash
  // out of continuous read, so that it accepts commands after a warm reset.
  std::array<std::uint32_t, 3> read_sequence{0x0A18'04EB, 0x3204'1EFF, 0x0000'2601};
  std::array<std::uint32_t, 77> reserved_8c{};
  std::uint32_t page_bytes = 256;
  std::uint32_t sector_bytes = 4096;
  std::uint32_t command_clock = 1;  // 30 MHz
  std::uint32_t reserved_1cc = 0;
  std::uint32_t block_bytes = 0x0001'0000;
  std::array<std::uint32_t, 11> reserved_1d4{};
};
static_assert(sizeof(FlashConfiguration) == 512);

struct BootData {
  const void* start;
  const void* length;  // a symbol of the linker whose address is the number
  std::uint32_t plugin;
};

struct VectorTable {
  std::uint32_t header;
  void (*entry)();
  std::uint32_t reserved_08, device_configuration;
  const BootData* boot_data;
  const VectorTable* self;
  std::uint32_t signature, reserved_1c;
};

struct ImageInfo {
  std::array<char, 12> name{"Astrolabe"};
  Version version = kFirmwareVersion;
  std::uint8_t bytes = 32;  // of this record; 0 in images that do not name their board
  std::array<char, 16> board{"teensy40"};
};
static_assert(sizeof(ImageInfo) == 32);

}  // namespace

extern "C" {

extern const std::uint8_t image_start, image_length;

[[gnu::section(".flash_configuration")]] extern const FlashConfiguration flash_configuration;
[[gnu::used]] const FlashConfiguration flash_configuration{};

/// The true length, because newer boot loaders of the Teensy erase by it.
[[gnu::section(".boot_data")]] extern const BootData boot_data;
[[gnu::used]] const BootData boot_data{&image_start, &image_length, 0};

/// The header word is the one that those boot loaders look for.
[[gnu::section(".image_vector_table")]] extern const VectorTable image_vector_table;
[[gnu::used]] const VectorTable image_vector_table{0x4320'00D1,         reset, 0, 0, &boot_data,
                                                   &image_vector_table, 0,     0};

/// Identifies the image to programs that flash it (host/formats/files/firmware_image).
[[gnu::section(".image_info")]] extern const ImageInfo image_info;
[[gnu::used]] const ImageInfo image_info{};

}  // extern "C"

}  // namespace astro::teensy40
