#include "host/robot/sharing/driver_rule.hpp"

#include "host/robot/sharing/request_rules.hpp"

namespace astro::robot {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages

const PortUser* DriverRule::stopper_of(SessionId id) const {
  const auto found = stops_.find(id);
  return found == stops_.end() || !found->second.by ? nullptr : &*found->second.by;
}

std::uint16_t DriverRule::stops_of_others(SessionId id) const {
  return static_cast<std::uint16_t>(stops_at_robot_ + all_stops_ - stops_.at(id).own);
}

std::uint16_t DriverRule::tell_stops(SessionId id, std::uint16_t at_robot) {
  stops_at_robot_ = at_robot;
  const std::uint16_t stops = stops_of_others(id);
  stops_.at(id).told = stops;
  return stops;
}

std::optional<ErrorReply> DriverRule::refusal(SessionId id, std::uint8_t message) const {
  const bool taken = driver_ && driver_ != id && !(confirmed_ && rule_.stopped());
  if (message == Arm::kId && taken) return ErrorReply{ErrorCode::busy, 0};
  if (message == Arm::kId) {
    const auto& told = stops_.at(id).told;
    return told && *told != stops_of_others(id) ? std::optional(ErrorReply{ErrorCode::not_armed, 0})
                                                : std::nullopt;
  }
  if (message == Resume::kId && !rule_.driver())
    return std::nullopt;  // it may be for a driver at another port
  if (rule_.permits(id, message)) return std::nullopt;
  return ErrorReply{taken ? ErrorCode::busy : ErrorCode::not_armed, 0};
}

void DriverRule::note_request(SessionId id, std::uint8_t message) {
  if (message != Arm::kId || driver_ == id) return;
  driver_ = id;
  confirmed_ = false;
}

void DriverRule::note_halt(SessionId id, std::uint8_t message, const PortUser& by) {
  rule_.note(id, message);
  if (!protocol::stops(message) || last_ == id) return;
  ++all_stops_;
  ++stops_.at(id).own;
  for (auto& [stopped, stops] : stops_)
    if (stopped != id && !stops.by) stops.by = by;
}

void DriverRule::note_answer(SessionId id, std::uint8_t request, std::optional<ErrorCode> refused) {
  if (!refused) rule_.note(id, request);
  certainly_stopped_ = certainly_stopped_ || (!refused && protocol::stops(request));
  if (request == Arm::kId) note_answer_to_arm(id, !refused);
  // A driver that gets not_armed was stopped by somebody at another port of the robot.
  const bool motion = request == Velocity::kId || request == WheelVoltage::kId || request == AddSegment::kId;
  if (motion && refused == ErrorCode::not_armed && rule_.drives(id)) rule_.note(id, Stop::kId);
  const bool disarms = request == Disarm::kId || request == Reboot::kId || request == EnterBootloader::kId;
  if (disarms && !refused) end_drive();
}

/// If the robot accepts an Arm, its sender is the driver, even if a Disarm of another program came in
/// between.
void DriverRule::note_answer_to_arm(SessionId id, bool accepted) {
  if (accepted) {
    driver_ = last_ = id;
    confirmed_ = true;
    certainly_stopped_ = false;
    stops_.at(id).by.reset();
  } else if (driver_ == id && !confirmed_) {
    end_drive();
  }
}

std::optional<SessionId> DriverRule::confirmed_driver() const {
  return confirmed_ && !rule_.stopped() ? driver_ : std::nullopt;
}

void DriverRule::end_drive() {
  driver_.reset();
  rule_.end();
}

void DriverRule::release(SessionId id) {
  if (driver_ == id) end_drive();
  stops_.at(id).by.reset();
}

void DriverRule::remove(SessionId id) {
  release(id);
  stops_.erase(id);
}

}  // namespace astro::robot
