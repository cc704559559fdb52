#pragma once

#include <cstdint>

namespace astro {

/// Of the firmware; Hello tells it to hosts.
struct Version {
  std::uint8_t major = 0, minor = 1, patch = 0;
};
inline constexpr Version kFirmwareVersion{};

}  // namespace astro
