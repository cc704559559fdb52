#pragma once

#include <cstdint>

namespace astro {

/// The version of firmware and host tools, which are released together. HelloReply carries it.
struct Version {
  std::uint8_t major = 0, minor = 1, patch = 0;
};
inline constexpr Version kFirmwareVersion{};

}  // namespace astro
