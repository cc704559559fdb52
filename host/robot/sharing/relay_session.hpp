#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/protocol/frame.hpp"
#include "host/base/bytes.hpp"
#include "host/robot/port/transport.hpp"
#include "host/robot/sharing/frame_queue.hpp"
#include "host/robot/sharing/relay_messages.hpp"
#include "host/robot/sharing/telemetry_request.hpp"

namespace astro::robot {

/// A program at a shared port.
struct PortUser {
  std::uint32_t pid = 0;
  std::string command;
};

using SessionId = int;

/// Writes another request id into a body, which begins with the message id (one byte) and the request id.
inline void set_request_id(std::span<std::uint8_t> body, std::uint16_t id) { store(body, 1, id); }

/// One request under way: as the program sent it, and with the id that it has for the robot.
struct Exchange {
  Exchange() = default;
  Exchange(const protocol::Header& sent_header, std::span<const std::uint8_t> sent_body)
      : header(sent_header), body(sent_body.begin(), sent_body.end()) {}

  enum class State : std::uint8_t { waits, sent };
  protocol::Header header;          // as the program sent it
  std::uint16_t robot_id = 0;       // 0: not assigned yet
  std::vector<std::uint8_t> frame;  // for the robot, as soon as it has an id
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
  bool has_slot = false;  // may drive, change parameters or have telemetry

  std::optional<Exchange> current;
  // Pings change nothing and the robot does not remember them, so several may be under way. A new one
  // overwrites the oldest.
  std::array<Exchange, 4> pings;
  std::size_t next_ping = 0;

  // The last answered request and its answer, as the robot remembers them for a port.
  protocol::Header answered;
  std::vector<std::uint8_t> answer;

  TelemetryRequest telemetry;
  std::optional<PortUser>
      stopped_by;  // the program that stopped its drive; cleared when it arms the robot again

  void forget() {
    current.reset();
    pings = {};
    answer.clear();
  }
};

}  // namespace astro::robot
