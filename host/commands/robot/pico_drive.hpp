#pragma once

#include <filesystem>

namespace astro::commands {

/// Waits until the drive of an RP2040's boot loader is mounted, or is there where the environment variable ASTROLABE_PICO_DRIVE
/// says, and copies the image to it; the chip starts it by itself. Throws astro::Error if none appears within two minutes or
/// the copy fails, Interrupted on Ctrl-C.
void copy_to_pico(const std::filesystem::path& uf2);

}  // namespace astro::commands
