#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/protocol/frame.hpp"
#include "host/robot/sharing/frame_queue.hpp"
#include "host/robot/sharing/relay_messages.hpp"
#include "host/robot/sharing/telemetry_request.hpp"
#include "host/robot/port/transport.hpp"

namespace astro::robot {

/// A program at a shared port.
struct PortUser {
  std::uint32_t pid = 0;
  std::string command;
};

using SessionId = int;

/// One request on its way: as the program sent it, and under the id that the robot knows it by.
struct Exchange {
  Exchange() = default;
  Exchange(const protocol::Header& sent_header, std::span<const std::uint8_t> sent_body)
      : header(sent_header), body(sent_body.begin(), sent_body.end()) {}

  enum class State : std::uint8_t { waits, sent };
  protocol::Header header;          // as the program sent it
  std::uint16_t robot_id = 0;       // 0: not chosen yet
  std::vector<std::uint8_t> frame;  // for the robot, once the id is chosen
  std::vector<std::uint8_t> body;   // as the program sent it
  State state = State::waits;
  microseconds sent_at{};
};

/// What the relay remembers of one program.
struct RelaySession {
  SessionId id = 0;
  PortUser user;
  bool greets = true;

  protocol::Framer framer;
  FrameQueue out;  // to the program
  std::uint64_t dropped = 0;
  std::optional<Farewell> closing;
  bool has_place = false;  // one of those that are limited

  std::optional<Exchange> current;
  // Pings change nothing and are not remembered by the robot, so that several may be under way: the newest
  // stands at the next place to be overwritten.
  std::array<Exchange, 4> pings;
  std::size_t next_ping = 0;

  // The last request that was answered and its answer, as the robot remembers them of a port.
  protocol::Header answered;
  std::vector<std::uint8_t> answer;

  TelemetryWish telemetry;
  std::optional<PortUser> stopped_by;  // another program ended its drive; until it arms the robot again

  void forget() {
    current.reset();
    pings = {};
    answer.clear();
  }
};

}  // namespace astro::robot
