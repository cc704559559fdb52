#pragma once

#include <string>

#include "host/base/byte_source.hpp"

/// Text that was packed with gzip, as archives of recordings keep it.
namespace astro::tables {

/// Why a file cannot be unpacked. Values: its name, and the byte up to which it could be, or how many MiB can
/// be held.
enum class PackedProblem { cut_off, damaged, too_large };

bool is_gzip(ByteView bytes);

/// Returns the text. Together with 72 bytes for the pose of each line, it may take four times the size of the file, and 56
/// MiB more. Throws astro::Error naming `name` if it is damaged, is cut off, or would take more.
Bytes unpacked(ByteSource& file, const std::string& name);

}  // namespace astro::tables
