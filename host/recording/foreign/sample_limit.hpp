#pragma once

#include <cstdint>
#include <filesystem>

namespace astro::recording {

/// Throws astro::Error naming the bag if it holds more samples than any recording of its size: more than 300,000, and
/// one for each 24 bytes of its files. What a robot that stands still sends packs best, because its messages differ only
/// in their times; it takes 26 bytes a message. `what` names the samples: "poses".
void require_possible(std::uint64_t samples, const char* what, const std::filesystem::path& path);

}  // namespace astro::recording
