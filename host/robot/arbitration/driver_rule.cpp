#include "host/robot/arbitration/driver_rule.hpp"

#include "host/robot/arbitration/request_rules.hpp"

namespace astro::robot {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages

const PortUser* DriverRule::stopper_of(SessionId id) const {
  const auto found = stoppers_.find(id);
  return found == stoppers_.end() || !found->second ? nullptr : &*found->second;
}

std::optional<ErrorReply> DriverRule::refusal(SessionId id, std::uint8_t message) const {
  const bool taken = driver_ && driver_ != id && !(confirmed_ && rule_.stopped());
  if (message == Arm::kId) return taken ? std::optional(ErrorReply{ErrorCode::busy, 0}) : std::nullopt;
  if (message == Resume::kId && !rule_.driver())
    return std::nullopt;  // it may be for a driver at another port
  if (rule_.permits(id, message)) return std::nullopt;
  return ErrorReply{taken ? ErrorCode::busy : ErrorCode::not_armed, 0};
}

void DriverRule::note_request(SessionId id, std::uint8_t message) {
  if (message != Arm::kId || driver_ == id) return;
  driver_ = id;
  confirmed_ = false;
  stoppers_.try_emplace(id);
}

void DriverRule::note_halt(SessionId id, std::uint8_t message, const PortUser& by) {
  rule_.note(id, message);
  if (!request_rules::stops(message)) return;
  for (auto& [stopped, stopper] : stoppers_)
    if (stopped != id && !stopper) stopper = by;
}

void DriverRule::note_answer(SessionId id, std::uint8_t request, std::optional<ErrorCode> refused) {
  if (!refused) rule_.note(id, request);
  if (request == Arm::kId) note_answer_to_arm(id, !refused);
  // Somebody at another port of the robot has stopped it.
  const bool motion = request == Velocity::kId || request == WheelVoltage::kId || request == AddSegment::kId;
  if (motion && refused == ErrorCode::not_armed && rule_.drives(id)) rule_.note(id, Stop::kId);
  const bool disarms = request == Disarm::kId || request == Reboot::kId || request == EnterBootloader::kId;
  if (disarms && !refused) end_drive();
}

/// A program that the robot lets drive is the driver, also if another's Disarm ended its claim in between.
void DriverRule::note_answer_to_arm(SessionId id, bool accepted) {
  if (accepted) {
    driver_ = id;
    confirmed_ = true;
    stoppers_[id].reset();
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
  stoppers_.erase(id);
}

void DriverRule::clear() {
  end_drive();
  stoppers_.clear();
}

}  // namespace astro::robot
