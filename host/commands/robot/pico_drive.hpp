#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace astro::commands {

/// The drive of an RP2040's boot loader among the mounts of this computer, as /proc/self/mounts has them. A mount whose device is
/// gone is none. Throws astro::Error if there are two: which of them is meant is not known.
std::optional<std::filesystem::path> pico_drive_among(const std::string& mounts);

/// Waits until the drive of an RP2040's boot loader is mounted, or is there where the environment variable ASTROLABE_PICO_DRIVE
/// says, and copies the image to it; the chip starts it by itself. Throws astro::Error if none appears within two minutes or
/// the copy fails, Interrupted on Ctrl-C.
void copy_to_pico(const std::filesystem::path& uf2);

}  // namespace astro::commands
