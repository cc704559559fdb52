#pragma once

#include <cstdint>
#include <filesystem>

namespace astro::importing {

/// Throws astro::Error naming the bag if it holds more samples than are taken from one of its size: more than 300,000, and
/// one for each `least_bytes` of its files. What a robot that stands still sends packs best, because its messages differ
/// only in their times: 26 bytes a message; that of a robot which drives takes 50 and more. `what` names the samples:
/// "poses".
void require_possible(std::uint64_t samples, std::uint64_t least_bytes, const char* what,
                      const std::filesystem::path& path);

}  // namespace astro::importing
