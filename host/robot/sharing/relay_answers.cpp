#include <algorithm>
#include <array>
#include <utility>

#include "common/protocol/messages.hpp"
#include "host/robot/sharing/relay.hpp"

/// From the robot to the programs.
namespace astro::robot {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages

namespace {

/// Request ids are reused after some time, so an answer to an older request than this belongs to another one.
/// No program waits that long between two tries.
constexpr microseconds kAnswerTimeout = std::chrono::seconds(3);

bool is_answered_by(const Exchange& exchange, const Header& answer, microseconds now) {
  return exchange.robot_id == answer.request_id && now < exchange.sent_at + kAnswerTimeout;
}

/// The same answer with the request id that the program used.
std::vector<std::uint8_t> addressed(std::span<const std::uint8_t> body, const Header& request) {
  std::vector<std::uint8_t> bytes(body.begin(), body.end());
  set_request_id(bytes, request.request_id);
  return bytes;
}

/// Only the program that staged a value may see it.
void hide_staged(std::vector<std::uint8_t>& body, const Header& request) {
  const auto decoded = decode<ParameterValue>(body);
  if (!decoded.ok()) return;
  ParameterValue value = *decoded;
  value.staged = value.active;
  value.staged_text = value.active_text;
  std::array<std::uint8_t, kMaxBody> bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  body.assign(bytes.begin(), bytes.begin() + encode(value, request.request_id, bytes));
}

}  // namespace

void Relay::take_answer(const Header& header, Body body, microseconds now) {
  for (RelaySession& session : sessions_) {
    for (Exchange& ping : session.pings) {
      if (!is_answered_by(ping, header, now)) continue;
      const Exchange answered = std::exchange(ping, {});
      return reply(session, answered.header, addressed(body, answered.header));
    }
    if (!session.current || !is_answered_by(*session.current, header, now)) continue;
    const Header asked = session.current->header;
    if (under_way_ == session.id) under_way_.reset();
    std::erase(waiting_, session.id);
    note_answer(session, asked.message_id, body);
    std::vector<std::uint8_t> bytes = addressed(body, asked);
    if (header.message_id == ParameterValue::kId && staging_.opened && staging_.owner != session.id)
      hide_staged(bytes, asked);
    session.current.reset();
    reply(session, asked, bytes);
    return next_onlooker(now);
  }
}

void Relay::note_answer(RelaySession& session, std::uint8_t request, Body body) {
  const bool taken = body.front() != ErrorReply::kId;
  note_motion(session, request, taken);
  if (request == CommitParameters::kId && taken) hello_.reset();  // the robot's name may have changed
  if (request != Hello::kId) return;
  const auto hello = decode<HelloReply>(body);
  if (!hello.ok()) return;
  hello_ = *hello;
  telemetry_changed_ = true;  // a Hello ends the telemetry of its port
}

void Relay::note_motion(RelaySession& session, std::uint8_t request, bool taken) {
  switch (request) {
    case Arm::kId:
      if (taken) session.stopped_by.reset();
      [[fallthrough]];
    case Velocity::kId:
    case WheelVoltage::kId:
    case AddSegment::kId:
      if (driver_ != session.id) return;
      driver_confirmed_ = driver_confirmed_ || taken;
      if (!driver_confirmed_) driver_.reset();
      return;
    case Disarm::kId:
    case Reboot::kId:
    case EnterBootloader::kId:
      if (taken) driver_.reset();
      return;
    default:
      return;
  }
}

void Relay::take_event(Body body) {
  if (body.front() == Telemetry::kId) return distribute(body);
  if (body.front() == FaultRaised::kId) driver_.reset();
  if (body.front() == Booted::kId) note_restart();
  std::array<std::uint8_t, kMaxFrame> frame;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const Body bytes = std::span(frame).first(encode_frame(body, frame));
  for (RelaySession& session : sessions_) push(session, bytes);
}

/// After a restart the robot has forgotten all of this.
void Relay::note_restart() {
  hello_.reset();
  driver_.reset();
  staging_ = {};
  stream_ = {};
  telemetry_changed_ = false;
  under_way_.reset();
  waiting_.clear();
  for (RelaySession& session : sessions_) {
    session.forget();
    session.telemetry = {};
    session.stopped_by.reset();
  }
}

}  // namespace astro::robot
