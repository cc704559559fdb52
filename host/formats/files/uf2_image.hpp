#pragma once

#include <filesystem>

#include "host/formats/files/firmware_image.hpp"

namespace astro {

/// Why a file is no image for an RP2040. Values: the file; of damaged also the block, counted from 1.
enum class Uf2Problem { unreadable, too_large, of_other_board, damaged };

/// Whether a file begins as UF2 files do. False if it cannot be read.
bool begins_as_uf2(const std::filesystem::path& file);

/// Reads an image for an RP2040, a UF2 file, and checks what the chip's boot loader and its boot ROM would check, since both
/// are silent about a file that they do not take: every block, its family and its place, and the check sum of the second stage.
/// Throws astro::Error that says what is wrong with the file.
FirmwareImage read_uf2_image(const std::filesystem::path& file);

}  // namespace astro
