#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/protocol/codec.hpp"
#include "common/protocol/framer.hpp"
#include "common/protocol/messages.hpp"
#include "hal/interface/board.hpp"

namespace astro {

/// Writes frames to ports. A port takes a whole frame or nothing: a host that does not read loses frames,
/// never parts of frames.
///
/// The room at a port is shared out by rank: an answer takes whatever room there is; an event leaves room for
/// the largest answer; telemetry leaves room for two answers and some events.
///
/// Returns  each function: false if the frame was dropped for want of room.
template <hal::Ports Ports>
class FrameWriter {
 public:
  using Buffer = std::array<std::uint8_t, protocol::kMaxFrame>;

  explicit FrameWriter(Ports& ports) : ports_(ports) {}

  bool send_answer(int port, std::span<const std::uint8_t> frame) { return send(port, frame, 0); }

  template <protocol::Message M>
  bool send_event(int port, const M& event) {
    return send_unasked(port, event, kAnswerRoom);
  }

  bool send_telemetry(int port, const protocol::Telemetry& telemetry) {
    return send_unasked(port, telemetry, kTelemetryLeaves);
  }

  /// Writes the frame of `message` to `out` and returns its size.
  template <protocol::Message M>
  static std::size_t frame(const M& message, std::uint16_t request_id, Buffer& out) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): encode fills it
    std::array<std::uint8_t, protocol::kMaxBody> body;
    const std::size_t size = protocol::encode(message, request_id, body);
    return protocol::encode_frame(std::span(body).first(size), out);
  }

 private:
  static constexpr std::size_t kAnswerRoom = protocol::kMaxReplyFrame;
  static constexpr std::size_t kTelemetryLeaves = 2 * kAnswerRoom + 8 * protocol::kMaxEventFrame;

  template <protocol::Message M>
  bool send_unasked(int port, const M& message, std::size_t leaves) {
    Buffer out;  // NOLINT(cppcoreguidelines-pro-type-member-init): frame() fills it
    return send(port, std::span(out).first(frame(message, 0, out)), leaves);
  }

  bool send(int port, std::span<const std::uint8_t> bytes, std::size_t leaves) {
    if (ports_.room(port) < bytes.size() + leaves) return false;
    return ports_.write(port, bytes) == bytes.size();
  }

  Ports& ports_;
};

}  // namespace astro
