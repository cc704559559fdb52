#pragma once

#include <filesystem>

#include "host/base/byte_source.hpp"

namespace astro::tables {

/// The whole text of a file in UTF-8. A file that is packed with gzip is unpacked, and one in UTF-16 (with a byte order mark,
/// or with a zero in every other byte) is recoded. Throws astro::Error naming the file if it cannot be read, if it
/// should be part of a bag by its name, or if the packed text is damaged or would take too much memory (packed_text.hpp).
Bytes text_of_file(const std::filesystem::path& path);

/// The same for a text that was read; one that is not in UTF-16 is returned as it is.
Bytes in_utf8(Bytes text);

}  // namespace astro::tables
