#pragma once

#include <string>

#include "host/base/bytes.hpp"

/// Text that was packed with gzip, as archives of recordings keep it.
namespace astro::truth {

bool is_gzip(ByteView bytes);

/// The text. It may be four times as long as the file, and 32 MiB more.
/// Throws astro::Error naming `file` if it is damaged, is cut off, or would be longer.
std::string unpacked(ByteView bytes, const std::string& file);

}  // namespace astro::truth
