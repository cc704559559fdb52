#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/protocol/codec.hpp"
#include "common/protocol/messages.hpp"

namespace astro::tests {

/// What encode writes, alone.
template <protocol::Message M>
std::vector<std::uint8_t> body_of(const M& message, std::uint16_t request_id) {
  std::array<std::uint8_t, protocol::kMaxBody> out{};
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(protocol::encode(message, request_id, out))};
}

}  // namespace astro::tests
