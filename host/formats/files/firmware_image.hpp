#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace astro {

/// Why a file is no image for a Teensy 4.0. Values: the file; of not_intel_hex also the line, counted from 1.
enum class ImageProblem { unreadable, too_large, of_other_board, not_intel_hex };

/// What flashing a file writes into the board's program memory.
struct FirmwareImage {
  static constexpr std::uint32_t kBase = 0x6000'0000;  // of a Teensy 4.0
  static constexpr std::uint32_t kBytes = 0x1F'0000;   // the parameters begin after it, on every board

  std::vector<std::uint8_t> flash;  // from the board's base on; 0xFF where the file has no data
  std::string version;              // "0.1.0"; empty: not firmware of Astrolabe
  std::string board;                // "teensy40"; empty: not stated
};

/// Reads version and board from the record at `at` of image.flash; both stay empty if it is not Astrolabe's.
void read_image_info(FirmwareImage& image, std::size_t at);

/// Reads an image for a Teensy 4.0, an Intel HEX file, and checks its checksums, its addresses and the header that the chip's boot ROM
/// reads. Throws astro::Error that says what is wrong with the file.
FirmwareImage read_firmware_image(const std::filesystem::path& hex);

}  // namespace astro
