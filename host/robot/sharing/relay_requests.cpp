#include <algorithm>
#include <array>

#include "common/protocol/messages.hpp"
#include "host/robot/sharing/relay.hpp"
#include "host/robot/sharing/relay_rules.hpp"

/// From the programs to the robot.
namespace astro::robot {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages

namespace {

constexpr std::uint16_t kOnlooker = 0x8000;  // bit 15 of a request id
// More frames than wait when all programs ask at the same time; beyond that the line itself has stopped.
constexpr std::size_t kMostQueuedFrames = 256;

}  // namespace

template <Message M>
void Relay::reply_with(RelaySession& session, const Header& request, const M& message) {
  std::array<std::uint8_t, kMaxBody> body;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  reply(session, request, std::span(body).first(encode(message, request.request_id, body)));
}

/// `body` has the request id that the program used.
void Relay::reply(RelaySession& session, const Header& request, Body body) {
  std::array<std::uint8_t, kMaxFrame> frame;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const Body bytes = std::span(frame).first(encode_frame(body, frame));
  push(session, bytes);
  if (request.message_id == Ping::kId || request.message_id == Hello::kId) return;
  session.answered = request;
  session.answer.assign(bytes.begin(), bytes.end());
  if (session.current && session.current->header == request) session.current.reset();
}

void Relay::take(RelaySession& session, Body body, microseconds now) {
  const Header header = *peek(body);
  if (header.request_id == 0 || session.closing) return;
  if (header.message_id == Ping::kId) return take_ping(session, header, body, now);
  if (relay_rules::needs_slot(header.message_id) && !give_slot(session)) return;
  if (!session.answer.empty() && session.answered == header) return push(session, session.answer);
  if (take_here(session, header, body)) return;
  if (const auto refused = refusal(session, header.message_id)) return reply_with(session, header, *refused);
  if (relay_rules::stops(header.message_id)) note_stopped_driver(session);
  if (session.current && session.current->header == header) return repeat(session, now);
  begin(session, Exchange(header, body), now);
}

/// Answers requests that do not need the robot; returns false for all others.
bool Relay::take_here(RelaySession& session, const Header& header, Body body) {
  if (header.message_id == GetPortUsers::kId) {
    PortUsers users;
    const RelaySession* driver = driver_ ? find(*driver_) : nullptr;
    if (driver != nullptr && driver_confirmed_) {
      users.driver_pid = driver->user.pid;
      users.driver_command = CommandLine(driver->user.command);
    }
    if (session.stopped_by) {
      users.stopper_pid = session.stopped_by->pid;
      users.stopper_command = CommandLine(session.stopped_by->command);
    }
    reply_with(session, header, users);
    return true;
  }
  if (header.message_id == SetTelemetry::kId) {
    take_telemetry(session, header, body);
    return true;
  }
  return false;
}

void Relay::take_telemetry(RelaySession& session, const Header& header, Body body) {
  const auto request = decode<SetTelemetry>(body);
  if (!request.ok()) return reply_with(session, header, ErrorReply{ErrorCode::malformed, 0});
  if ((request->fields & ~Telemetry::kAll) != 0)
    return reply_with(session, header, ErrorReply{ErrorCode::out_of_range, 0});
  session.telemetry = TelemetryRequest(*request);
  telemetry_changed_ = true;  // even if nothing changed, because a robot that has restarted has forgotten it
  reply_with(session, header, Ack{});
}

void Relay::take_ping(RelaySession& session, const Header& header, Body body, microseconds now) {
  auto ping = std::find_if(session.pings.begin(), session.pings.end(),
                           [&](const Exchange& p) { return p.header == header; });
  if (ping == session.pings.end()) {
    ping = session.pings.begin() + static_cast<std::ptrdiff_t>(session.next_ping);
    session.next_ping = (session.next_ping + 1) % session.pings.size();
    *ping = Exchange(header, body);
  }
  send(session, *ping, now);
}

std::optional<ErrorReply> Relay::refusal(const RelaySession& session, std::uint8_t message) const {
  if (session.stopped_by && relay_rules::sets_in_motion(message) && message != Arm::kId)
    return ErrorReply{ErrorCode::not_armed, 0};
  if (!relay_rules::drives(message) || !driver_ || driver_ == session.id) return std::nullopt;
  const RelaySession* driver = find(*driver_);
  if (driver == nullptr || driver->stopped_by) return std::nullopt;
  return ErrorReply{ErrorCode::busy, 0};
}

/// Notes who stopped the driver, so that its next velocity is refused and the robot stays stopped.
void Relay::note_stopped_driver(const RelaySession& by) {
  if (!driver_ || driver_ == by.id) return;
  if (RelaySession* driver = find(*driver_); driver != nullptr && !driver->stopped_by)
    driver->stopped_by = by.user;
}

std::uint16_t Relay::fresh_id(const RelaySession& session) {
  next_id_ = static_cast<std::uint16_t>(next_id_ >= 0x7FFF ? 1 : next_id_ + 1);
  return driver_ == session.id ? next_id_ : static_cast<std::uint16_t>(next_id_ | kOnlooker);
}

/// Sends the request to the robot, with the same id each time.
void Relay::send(RelaySession& session, Exchange& exchange, microseconds now) {
  if (exchange.robot_id == 0) {
    exchange.robot_id = fresh_id(session);
    std::vector<std::uint8_t> body = exchange.body;
    set_request_id(body, exchange.robot_id);
    std::array<std::uint8_t, kMaxFrame> frame;  // NOLINT(cppcoreguidelines-pro-type-member-init)
    exchange.frame.assign(frame.data(), frame.data() + encode_frame(body, frame));
  }
  exchange.state = Exchange::State::sent;
  exchange.sent_at = now;
  const bool first = relay_rules::stops(exchange.header.message_id);
  if (first) to_robot_.withdraw();
  if (to_robot_.frames() >= (first ? 2 : 1) * kMostQueuedFrames) return;
  first ? to_robot_.push_first(exchange.frame)
        : to_robot_.push(exchange.frame, relay_rules::sets_in_motion(exchange.header.message_id));
}

void Relay::begin(RelaySession& session, Exchange exchange, microseconds now) {
  if (under_way_ == session.id) under_way_.reset();  // the program has given up its last request
  std::erase(waiting_, session.id);
  const std::uint8_t message = exchange.header.message_id;
  if (message == Hello::kId) return take_hello(session, std::move(exchange), now);
  if (relay_rules::drives(message) && driver_ != session.id) {
    driver_ = session.id;
    driver_confirmed_ = false;
  }
  session.current = std::move(exchange);
  const bool at_once = driver_ == session.id || relay_rules::stops(message);
  if (!at_once) return wait_for_turn(session);
  if (staging_allows(session, message)) send(session, *session.current, now);
}

/// The first Hello goes to the robot, where it ends the session of an earlier program; so does one after
/// which the robot's answer may differ. All others are answered here, because they would end the driver's
/// session.
void Relay::take_hello(RelaySession& session, Exchange exchange, microseconds now) {
  const auto hello = decode<Hello>(exchange.body);
  const Header header = exchange.header;
  if (!hello.ok()) return reply_with(session, header, ErrorReply{ErrorCode::malformed, 0});
  release(session);
  if (!hello_) {
    session.current = std::move(exchange);
    if (driver_) return wait_for_turn(session);
    driver_ = session.id;  // only for the id: it shows the robot that nobody drives
    send(session, *session.current, now);
    driver_.reset();
  } else if (hello->protocol_version != hello_->protocol_version) {
    reply_with(session, header, ErrorReply{ErrorCode::wrong_version, hello_->protocol_version});
  } else {
    reply_with(session, header, *hello_);
  }
}

void Relay::repeat(RelaySession& session, microseconds now) {
  Exchange& exchange = *session.current;
  // Only frames are passed on. These bytes tell a program that sends Hello that the device sends something
  // else.
  constexpr std::array<std::uint8_t, 2> kNoFrame{0x55, 0};
  if (noise_ && exchange.header.message_id == Hello::kId) push(session, kNoFrame);
  // Another program has sent Hello or drives by now, and a Hello with an owner's id would end its session.
  const bool owners = exchange.state == Exchange::State::sent && (exchange.robot_id & kOnlooker) == 0;
  if (exchange.header.message_id == Hello::kId && (hello_ || (driver_ && owners)))
    return take_hello(session, Exchange(exchange.header, std::vector(exchange.body)), now);
  if (exchange.state == Exchange::State::waits) return;
  const bool onlooker =
      (exchange.robot_id & kOnlooker) != 0 && !relay_rules::stops(exchange.header.message_id);
  if (!onlooker || under_way_ == session.id) return send(session, exchange, now);
  exchange.state = Exchange::State::waits;  // its turn ended before the answer came
  wait_for_turn(session);
}

/// Checked when the request is sent to the robot, not when it arrived, because others may have opened the
/// area meanwhile. Returns false if the request was refused.
bool Relay::staging_allows(const RelaySession& asker, std::uint8_t message) {
  if (relay_rules::opens_staging(message)) staging_ = {true, asker.id};
  if (!relay_rules::needs_staging(message) || !staging_.opened || staging_.owner == asker.id) return true;
  RelaySession& session = *find(asker.id);
  const Header header = session.current->header;
  reply_with(session, header, ErrorReply{ErrorCode::staging_lost, 0});
  return false;
}

}  // namespace astro::robot
