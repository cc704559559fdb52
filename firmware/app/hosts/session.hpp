#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/protocol/frame.hpp"
#include "common/protocol/messages.hpp"

namespace astro {

/// What the robot remembers of the hosts at one port: the program that has opened it (its owner) and
/// onlookers that share it.
struct Session {
  protocol::Framer framer;

  std::uint64_t telemetry_period_us = 0;  // 0: off
  std::uint64_t telemetry_due_us = 0;
  std::uint32_t telemetry_fields = 0;

  std::uint16_t stops_by_others = 0;  // hosts at other ports have stopped the robot so often
  bool stops_unread = false;          // and at least once since a host at this port asked for the status

  bool telemetry_due(std::uint64_t now_us) const {
    return telemetry_period_us != 0 && now_us >= telemetry_due_us;
  }
  void telemetry_sent(std::uint64_t now_us) {
    telemetry_due_us += telemetry_period_us;
    // After a delay the missing samples are not sent in a burst.
    if (telemetry_due_us <= now_us) telemetry_due_us = now_us + telemetry_period_us;
  }

  /// Remembers the last request and its answer. A host that missed the answer repeats the request with the
  /// same id, and a segment must not be driven twice because of that. The owner and the onlookers have a
  /// place each.
  void remember(const protocol::Header& header, std::span<const std::uint8_t> frame) {
    Answered& last = last_[protocol::from_onlooker(header)];
    last.header = header;
    last.size = static_cast<std::uint16_t>(frame.size());
    std::copy(frame.begin(), frame.end(), last.frame.begin());
  }
  void forget() {
    for (Answered& last : last_) last.size = 0;
  }
  /// The answer that this very request got; empty if the request is a new one.
  std::span<const std::uint8_t> answer(const protocol::Header& header) const {
    const Answered& last = last_[protocol::from_onlooker(header)];
    return std::span(last.frame).first(last.header == header ? last.size : 0U);
  }

 private:
  struct Answered {
    protocol::Header header;
    std::uint16_t size = 0;
    std::array<std::uint8_t, protocol::kMaxReplyFrame> frame{};
  };

  std::array<Answered, 2> last_;  // the owner's, the onlookers'
};

}  // namespace astro
