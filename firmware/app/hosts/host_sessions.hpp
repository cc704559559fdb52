#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "common/protocol/driving_rule.hpp"
#include "common/protocol/messages.hpp"
#include "firmware/app/hosts/frame_writer.hpp"
#include "firmware/app/hosts/session.hpp"
#include "firmware/app/hosts/snapshot.hpp"
#include "firmware/app/tick/control_tick.hpp"

namespace astro {

/// The sender of a request: the program that has the port open, or an onlooker that shares the port with it.
struct HostId {
  int port = 0;
  bool onlooker = false;
  bool operator==(const HostId&) const = default;
};

/// The hosts at all ports: reads their requests, has them carried out, answers, and streams telemetry. It
/// knows who asks, who drives, and which answers were given last. Main loop only.
template <hal::Board Board>
class HostSessions {
 public:
  HostSessions(Board& board, SharedState<Board>& state)
      : board_(board), state_(state), writer_(board.ports()) {}

  /// Reads a bounded share of what has arrived at `port`, so that a port that never falls silent does not
  /// starve the others. Has each request carried out by `handler.handle(host, request)`.
  template <class Handler>
  void receive(int port, Handler& handler) {
    std::array<std::uint8_t, 64> bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init): read fills it
    for (int turn = 0; turn < 8; ++turn) {
      const std::size_t count = board_.ports().read(port, bytes);
      for (std::size_t i = 0; i < count; ++i)
        if (const auto body = sessions_[port].framer.push(bytes[i])) answer(port, *body, handler);
      if (count < bytes.size()) return;
    }
  }

  /// Sends telemetry if it is due. A sample that the port has no room for is lost, not sent later.
  void send_telemetry(int port) {
    Session& session = sessions_[port];
    if (!session.telemetry_due(board_.clock().now_us())) return;
    protocol::Telemetry telemetry;
    {
      const auto hold = board_.hold_tick();
      const auto& state = state_.get(hold);
      telemetry = snapshot(state.drive, state.clock.last_us(), state.battery_mv);
      if ((session.telemetry_fields & protocol::Telemetry::kFused) != 0)
        telemetry.fused = state.gyro.report(state.drive, state.clock.last_us());
    }
    telemetry.fields = session.telemetry_fields;
    writer_.send_telemetry(port, telemetry);
    session.telemetry_sent(board_.clock().now_us());
  }

  Session& session(int port) { return sessions_[port]; }
  /// A program has opened the port, so the one that had it before is gone. Returns whether that one drove.
  bool end_drive(int port) {
    sessions_[port].stops_unread = false;
    const bool drove = rule_.driver() && rule_.driver()->port == port;
    if (drove) rule_.end();
    return drove;
  }
  bool drives(const HostId& host) const { return rule_.drives(host); }
  /// For the status that this host gets.
  std::uint16_t read_stops(const HostId& host) {
    sessions_[host.port].stops_unread = false;
    return sessions_[host.port].stops_by_others;
  }
  bool has_unread_stops(const HostId& host) const { return sessions_[host.port].stops_unread; }
  bool permits(const HostId& host, std::uint8_t message) const { return rule_.permits(host, message); }

  /// Frames that were damaged, of all ports.
  std::uint32_t bad_frames() const {
    std::uint32_t bad = 0;
    for (const Session& session : sessions_) bad += session.framer.counts().bad();
    return bad;
  }

 private:
  using Ports = std::remove_reference_t<decltype(std::declval<Board&>().ports())>;
  using Writer = FrameWriter<Ports>;
  using ErrorCode = protocol::ErrorCode;

  template <class Handler>
  void answer(int port, std::span<const std::uint8_t> body, Handler& handler) {
    const protocol::Header header = *protocol::peek(body);  // the framer drops a body without a header
    if (header.request_id == 0) return;                     // that marks an event, which asks for nothing
    if (const auto again = sessions_[port].answer(header); !again.empty()) {
      writer_.send_answer(port, again);
      return;
    }
    const HostId host{port, protocol::from_onlooker(header)};
    note_arrival(host, header.message_id);
    bool known = false;
    protocol::Requests::visit([&]<protocol::Message M>() {
      if (M::kId != header.message_id) return;
      known = true;
      const auto request = protocol::decode<M>(body);
      if (request) {
        const auto reply = handler.handle(host, *request);
        if (reply) note_stop(host, header.message_id);
        if (reply) rule_.note(host, header.message_id);
        respond(port, header, reply);
      } else {
        respond(port, header, protocol::Answer<typename M::Reply>({ErrorCode::malformed}));
      }
    });
    if (!known) respond(port, header, protocol::Answer<protocol::Ack>({ErrorCode::unknown_message}));
  }

  /// A request of the driver is a sign of life that keeps its drive going; none of an onlooker or at another port is.
  void note_arrival(const HostId& host, std::uint8_t message) {
    if (message == protocol::Hello::kId || !rule_.drives(host)) return;
    const auto hold = board_.hold_tick();
    state_.get(hold).drive.host_seen();
  }

  /// Who ends its own drive stops nobody else's, and what programs at one port do to each other is known there.
  void note_stop(const HostId& host, std::uint8_t message) {
    if (!protocol::stops(message) || rule_.drives(host)) return;
    for (Session& each : sessions_) {
      if (&each == &sessions_[host.port]) continue;
      ++each.stops_by_others;
      each.stops_unread = true;
    }
  }

  template <class Reply>
  [[gnu::cold]] void respond(int port, const protocol::Header& header, const protocol::Answer<Reply>& reply) {
    typename Writer::Buffer out;  // NOLINT(cppcoreguidelines-pro-type-member-init): frame() fills it
    const std::size_t size = reply ? Writer::frame(*reply, header.request_id, out)
                                   : Writer::frame(reply.error(), header.request_id, out);
    const auto frame = std::span(out).first(size);
    writer_.send_answer(port, frame);
    if (!is_carried_out_again(header.message_id)) sessions_[port].remember(header, frame);
  }

  /// Whether a repeated request is carried out again instead of getting the same answer. A Pong must show the
  /// present time. Hello and the requests that halt the robot may be carried out twice; they must never be
  /// taken for an old request that had the same id before the ids wrapped.
  static constexpr bool is_carried_out_again(std::uint8_t message) {
    constexpr std::array kAgain{protocol::Ping::kId,          protocol::Hello::kId,  protocol::Stop::kId,
                                protocol::EmergencyStop::kId, protocol::Disarm::kId, protocol::Pause::kId};
    return std::find(kAgain.begin(), kAgain.end(), message) != kAgain.end();
  }

  Board& board_;
  SharedState<Board>& state_;
  Writer writer_;
  protocol::DrivingRule<HostId> rule_;
  std::array<Session, Ports::kPorts> sessions_{};
};

}  // namespace astro
