#include "host/robot/sharing/relay.hpp"

#include <algorithm>
#include <array>

#include "common/protocol/frame.hpp"
#include "common/protocol/messages.hpp"
#include "host/robot/sharing/request_rules.hpp"

namespace astro::robot {

using protocol::Header;

namespace {

// At most kMostSlots programs may do more than ask or stop. At most kMostSessions are connected; some of them
// may hang.
constexpr std::ptrdiff_t kMostSlots = 32;
constexpr std::size_t kMostSessions = 96;
constexpr std::size_t kTelemetryLimit_bytes = 1U << 16;
constexpr std::size_t kQueueLimit_bytes = 1U << 18;

}  // namespace

bool RelaySession::takes_telemetry() const { return out.bytes() <= kTelemetryLimit_bytes; }

bool RelaySession::push(ByteView frame) {
  if (out.bytes() + frame.size() > kQueueLimit_bytes) return false;
  out.push(frame);
  return true;
}

void RelaySession::close(FarewellReason reason) {
  closing = Farewell{reason};
  if (reason == FarewellReason::reads_too_slowly) out.drop_waiting();
  if (greets) out.push(protocol::Frame(*closing, 0).bytes());
}

RelaySession* Relay::find(SessionId id) {
  const auto found =
      std::find_if(sessions_.begin(), sessions_.end(), [&](const RelaySession& s) { return s.id == id; });
  return found == sessions_.end() ? nullptr : &*found;
}

const RelaySession* Relay::find(SessionId id) const { return const_cast<Relay*>(this)->find(id); }

SessionId Relay::join(PortUser user, bool greets) {
  RelaySession& session = sessions_.emplace_back();
  session.id = ++last_session_;
  session.greets = greets;
  requests_.join(session.id, std::move(user));
  if (greets) session.out.push(protocol::Frame(Welcome{}, 0).bytes());
  if (sessions_.size() > kMostSessions) make_room(session);
  return session.id;
}

void Relay::make_room(RelaySession& newcomer) {
  const auto silent = std::find_if(sessions_.begin(), sessions_.end(), [](const RelaySession& s) {
    return s.greets && !s.closing && s.is_silent();
  });
  close(silent != sessions_.end() ? *silent : newcomer, FarewellReason::too_many);
}

/// Returns false, and ends the session, if no slot is free.
bool Relay::give_slot(RelaySession& session) {
  if (session.has_slot) return true;
  const auto taken = std::count_if(sessions_.begin(), sessions_.end(),
                                   [](const RelaySession& s) { return s.has_slot && !s.closing; });
  session.has_slot = taken < kMostSlots;
  if (!session.has_slot) close(session, FarewellReason::too_many);
  return session.has_slot;
}

void Relay::leave(SessionId id) {
  if (sessions_.remove_if([&](const RelaySession& s) { return s.id == id; }) > 0) requests_.leave(id);
}

FrameQueue& Relay::to_session(SessionId id) { return find(id)->out; }

std::optional<FarewellReason> Relay::closing(SessionId id) const {
  const RelaySession* session = find(id);
  if (session == nullptr || !session->closing) return std::nullopt;
  return session->closing->reason;
}

void Relay::close_all(FarewellReason reason) {
  for (RelaySession& session : sessions_) close(session, reason);
}

void Relay::close(RelaySession& session, FarewellReason reason) {
  if (session.closing) return;
  requests_.release(session.id);
  session.close(reason);
}

void Relay::push(RelaySession& session, ByteView frame) {
  if (session.closing) return;
  if (!session.push(frame)) close(session, FarewellReason::reads_too_slowly);
}

void Relay::deliver_replies() {
  for (const Reply& reply : requests_.take_replies())
    if (RelaySession* session = find(reply.to)) push(*session, reply.frame);
}

void Relay::from_session(SessionId id, ByteView bytes, microseconds now) {
  RelaySession* session = find(id);
  if (session == nullptr) return;
  for (const std::uint8_t byte : bytes) {
    if (const auto body = session->framer.push(byte)) take(*session, *body, now);
  }
  tick(now);
}

void Relay::take(RelaySession& session, ByteView body, microseconds now) {
  const Header header = *protocol::peek(body);  // a framer's body always has a header
  if (header.request_id == 0) return;
  const auto is_heard = [&] { return !session.closing || request_rules::halts(header.message_id); };
  if (!is_heard()) return;
  if (request_rules::needs_slot(header.message_id) && !give_slot(session)) return;
  // Only frames are passed on. These bytes tell a program that sends Hello that the device sends something
  // else.
  constexpr std::array<std::uint8_t, 2> kNoFrame{0x55, 0};
  if (noise_ && header.message_id == protocol::Hello::kId && requests_.repeats(session.id, header))
    push(session, kNoFrame);
  if (!is_heard()) return;
  requests_.take(session.id, body, now);
  deliver_replies();
}

void Relay::from_robot(ByteView bytes, microseconds now) {
  for (const std::uint8_t byte : bytes) {
    const auto body = framer_.push(byte);
    if (!body) continue;
    if (protocol::peek(*body)->request_id == 0) {
      take_event(*body);
    } else {
      requests_.take_answer(*body, now);
      deliver_replies();
    }
  }
  noise_ = !bytes.empty() && framer_.counts().good == 0;
  tick(now);
}

void Relay::take_event(ByteView body) {
  if (body.front() == protocol::Telemetry::kId) {
    if (const auto sample = protocol::decode<protocol::Telemetry>(body); sample.ok()) distribute(*sample);
    return;
  }
  requests_.take_event(body);
  const Bytes frame = frame_of(body);
  for (RelaySession& session : sessions_) push(session, frame);
}

void Relay::distribute(const protocol::Telemetry& sample) {
  for (RelaySession& session : sessions_) {
    const auto part = requests_.telemetry_for(session.id, sample);
    if (part && session.takes_telemetry()) push(session, protocol::Frame(*part, 0).bytes());
  }
}

void Relay::tick(microseconds now) {
  requests_.tick(now);
  deliver_replies();
}

}  // namespace astro::robot
