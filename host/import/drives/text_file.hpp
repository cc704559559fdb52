#pragma once

#include <filesystem>

#include "host/base/bytes.hpp"

namespace astro::importing {

/// Whether the file begins like one that was compressed with gzip.
bool is_packed_text(const std::filesystem::path& path);

/// The whole text of a file, decompressed if necessary. Throws astro::Error naming the file if it cannot be
/// read, if it should be part of a bag by its name, or if the compressed text is damaged or would take too much memory
/// (host/truth/files/packed_text.hpp).
Bytes text_of_file(const std::filesystem::path& path);

}  // namespace astro::importing
