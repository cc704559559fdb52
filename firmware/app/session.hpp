#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/protocol/body.hpp"
#include "common/protocol/framer.hpp"

namespace astro {

/// What the robot remembers of the host on one port.
struct Session {
  protocol::Framer framer;

  std::uint64_t telemetry_period_us = 0;  // 0: off
  std::uint64_t telemetry_due_us = 0;
  std::uint32_t telemetry_fields = 0;

  bool telemetry_due(std::uint64_t now_us) const {
    return telemetry_period_us != 0 && now_us >= telemetry_due_us;
  }
  void telemetry_sent(std::uint64_t now_us) {
    telemetry_due_us += telemetry_period_us;
    if (telemetry_due_us <= now_us) telemetry_due_us = now_us + telemetry_period_us;  // late: do not catch up
  }

  /// The last request and its answer: a host that missed the answer asks again with the same id, and a
  /// segment must not be driven twice for that. An empty frame: forget.
  void remember(const protocol::Header& header, std::span<const std::uint8_t> frame) {
    answered_ = header;
    answer_size_ = frame.size();
    std::copy(frame.begin(), frame.end(), answer_.begin());
  }
  bool answered(const protocol::Header& header) const {
    return answer_size_ != 0 && header.request_id != 0 && answered_ == header;
  }
  std::span<const std::uint8_t> answer() const { return std::span(answer_).first(answer_size_); }

 private:
  protocol::Header answered_;
  std::array<std::uint8_t, protocol::kMaxFrame> answer_{};
  std::size_t answer_size_ = 0;
};

}  // namespace astro
