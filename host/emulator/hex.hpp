#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace astro::emulator {

/// Writes an Intel HEX file into the flash, as the boot loader does, and checks that it is an image for a
/// Teensy 4.0. Throws astro::Error that says what is wrong with the file.
void load_hex(const std::filesystem::path& path, std::span<std::uint8_t> flash);

}  // namespace astro::emulator
