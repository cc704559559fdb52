#pragma once

#include <cstdint>

namespace astro {

/// Of firmware and host tools, which are released together. Hello tells it to hosts.
struct Version {
  std::uint8_t major = 0, minor = 1, patch = 0;
};
inline constexpr Version kFirmwareVersion{};

}  // namespace astro
