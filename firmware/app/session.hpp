#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/protocol/framer.hpp"
#include "common/protocol/telemetry.hpp"

namespace astro {

/// What the robot remembers of the host on one port.
struct Session {
  protocol::Framer framer;

  // The last answered request and its answer: a host that missed the answer asks again with the same id, and
  // a segment must not be driven twice for that.
  std::uint8_t answered_message = 0;
  std::uint16_t answered_request = 0;
  std::array<std::uint8_t, protocol::kMaxFrame> answer{};
  std::size_t answer_size = 0;

  std::uint64_t telemetry_period_us = 0;  // 0: off
  std::uint64_t telemetry_due_us = 0;
  std::uint32_t telemetry_fields = 0;

  void forget_answer() { answer_size = 0; }
  bool answered(std::uint8_t message, std::uint16_t request) const {
    return answer_size != 0 && request != 0 && answered_message == message && answered_request == request;
  }

  bool telemetry_due(std::uint64_t now_us) const {
    return telemetry_period_us != 0 && now_us >= telemetry_due_us;
  }
  void telemetry_sent(std::uint64_t now_us) {
    telemetry_due_us += telemetry_period_us;
    if (telemetry_due_us <= now_us) telemetry_due_us = now_us + telemetry_period_us;  // late: do not catch up
  }
};

}  // namespace astro
