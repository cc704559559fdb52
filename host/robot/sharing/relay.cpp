#include "host/robot/sharing/relay.hpp"
#include "common/protocol/messages.hpp"

#include <algorithm>

namespace astro::robot {

namespace {

constexpr SessionId kSelf = 0;
// The most programs that do more than ask or stop; the most connections, some of which may be of hanging
// programs.
constexpr std::ptrdiff_t kMostSlots = 32;
constexpr std::size_t kMostSessions = 96;
// A program that computes or waits at a prompt for a while still gets the answers and events of that time,
// but of telemetry only as much as a serial port would buffer.
constexpr std::size_t kTelemetryLimit_bytes = 1U << 16;
constexpr std::size_t kQueueLimit_bytes = 1U << 18;

}  // namespace

Relay::Relay() {
  sessions_.emplace_back();
  sessions_.front().id = kSelf;
}

RelaySession* Relay::find(SessionId id) {
  const auto found =
      std::find_if(sessions_.begin(), sessions_.end(), [&](const RelaySession& s) { return s.id == id; });
  return found == sessions_.end() ? nullptr : &*found;
}

const RelaySession* Relay::find(SessionId id) const { return const_cast<Relay*>(this)->find(id); }

SessionId Relay::join(PortUser user, bool greets) {
  RelaySession& session = sessions_.emplace_back();
  session.id = next_session_++;
  session.user = std::move(user);
  session.greets = greets;
  if (greets) session.out.push(protocol::Frame(Welcome{}, 0).bytes());
  if (sessions_.size() > kMostSessions + 1) make_room(session);
  return session.id;
}

/// A program that has never sent anything is disconnected first: programs that hang must not keep out an
/// emergency stop.
void Relay::make_room(RelaySession& newcomer) {
  const auto silent = std::find_if(sessions_.begin(), sessions_.end(), [&](const RelaySession& s) {
    return s.greets && !s.closing && s.framer.counts().good == 0;
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
  RelaySession* session = find(id);
  if (session == nullptr) return;
  release(*session);
  sessions_.remove_if([&](const RelaySession& s) { return s.id == id; });
}

FrameQueue& Relay::to_session(SessionId id) { return find(id)->out; }

std::optional<FarewellReason> Relay::closing(SessionId id) const {
  const RelaySession* session = find(id);
  if (session == nullptr || !session->closing) return std::nullopt;
  return session->closing->reason;
}

void Relay::close_all(FarewellReason reason) {
  for (RelaySession& session : sessions_)
    if (session.id != kSelf) close(session, reason);
}

void Relay::close(RelaySession& session, FarewellReason reason) {
  if (session.closing) return;
  release(session);
  session.closing = Farewell{reason};
  if (reason == FarewellReason::reads_too_slowly) session.out.drop_waiting();
  if (session.greets) session.out.push(protocol::Frame(*session.closing, 0).bytes());
}

/// Drops everything that the session requested. The robot's own time-out ends its drive.
void Relay::release(RelaySession& session) {
  session.forget();
  if (driver_ == session.id) driver_.reset();
  if (staging_.owner == session.id) staging_.owner.reset();
  if (under_way_ == session.id) under_way_.reset();
  std::erase(waiting_, session.id);
  if (session.telemetry.any()) telemetry_changed_ = true;
  session.telemetry = {};
}

void Relay::push(RelaySession& session, Body frame) {
  if (session.closing || session.id == kSelf) return;
  if (session.out.bytes() + frame.size() > kQueueLimit_bytes)
    return close(session, FarewellReason::reads_too_slowly);
  session.out.push(frame);
}

void Relay::distribute(Body body) {
  const auto sample = protocol::decode<protocol::Telemetry>(body);
  if (!sample.ok()) return;
  for (RelaySession& session : sessions_) {
    if (session.closing || !session.telemetry.is_due(sample->device_time_us, stream_.period_ms)) continue;
    if (session.out.bytes() > kTelemetryLimit_bytes) {
      ++session.dropped;
      continue;
    }
    push(session, protocol::Frame(session.telemetry.filter(*sample), 0).bytes());
  }
}

void Relay::from_session(SessionId id, Body bytes, microseconds now) {
  RelaySession* session = find(id);
  if (session == nullptr || session->closing) return;
  for (const std::uint8_t byte : bytes) {
    if (const auto body = session->framer.push(byte)) take(*session, *body, now);
  }
  tick(now);
}

void Relay::from_robot(Body bytes, microseconds now) {
  for (const std::uint8_t byte : bytes) {
    const auto body = framer_.push(byte);
    if (!body) continue;
    const protocol::Header header = *protocol::peek(*body);  // a framer's body always has a header
    header.request_id == 0 ? take_event(*body) : take_answer(header, *body, now);
  }
  noise_ = !bytes.empty() && framer_.counts().good == 0;
  tick(now);
}

}  // namespace astro::robot
