#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "common/protocol/codec.hpp"
#include "common/protocol/framer.hpp"
#include "host/base/bytes.hpp"
#include "host/base/microseconds.hpp"

namespace astro::robot {

/// One request under way: as the program sent it, and as it goes to the robot, with an id of the relay.
struct Exchange {
  Exchange() = default;
  Exchange(const protocol::Header& sent_header, ByteView sent_body)
      : header(sent_header), body(sent_body.begin(), sent_body.end()) {}

  enum class State : std::uint8_t { waits, sent };
  protocol::Header header;     // as the program sent it
  Bytes body;                  // as the program sent it
  std::uint16_t robot_id = 0;  // 0: not assigned yet
  Bytes frame;                 // for the robot, as soon as it has an id
  State state = State::waits;
  microseconds sent_at{};

  bool is_sent() const { return state == State::sent; }
  /// Has an id that does not keep the robot's drive alive.
  bool has_onlookers_id() const { return (robot_id & protocol::kOnlookerBit) != 0; }

  /// Request ids are reused after some time, so an answer to a request older than three seconds belongs to
  /// another one. No program waits that long between two tries.
  bool is_answered_by(const protocol::Header& answer, microseconds now) const {
    constexpr microseconds kAnswerTimeout = std::chrono::seconds(3);
    return robot_id == answer.request_id && now < sent_at + kAnswerTimeout;
  }
};

/// The same body with another request id. A body begins with the message id (one byte) and the request id.
inline Bytes with_request_id(ByteView body, std::uint16_t id) {
  Bytes bytes(body.begin(), body.end());
  store(bytes, 1, id);
  return bytes;
}

template <protocol::Message M>
Bytes body_of(const M& message, std::uint16_t request_id) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): encode fills it
  std::array<std::uint8_t, protocol::kMaxBody> body;
  return {body.data(), body.data() + protocol::encode(message, request_id, body)};
}

inline Bytes frame_of(ByteView body) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): encode_frame fills it
  std::array<std::uint8_t, protocol::kMaxFrame> frame;
  return {frame.data(), frame.data() + protocol::encode_frame(body, frame)};
}

}  // namespace astro::robot
