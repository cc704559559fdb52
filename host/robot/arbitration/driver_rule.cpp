#include "host/robot/arbitration/driver_rule.hpp"

#include "host/robot/arbitration/request_rules.hpp"

namespace astro::robot {

using protocol::ErrorCode;
using protocol::ErrorReply;

const PortUser* DriverRule::stopper_of(SessionId id) const {
  const auto found = stopped_.find(id);
  return found == stopped_.end() ? nullptr : &found->second;
}

std::optional<ErrorReply> DriverRule::refusal(SessionId id, std::uint8_t message) const {
  if (stopped_.contains(id) && request_rules::sets_in_motion(message) && message != protocol::Arm::kId)
    return ErrorReply{ErrorCode::not_armed, 0};
  if (!request_rules::drives(message) || !driver_ || driver_ == id || stopped_.contains(*driver_))
    return std::nullopt;
  return ErrorReply{ErrorCode::busy, 0};
}

void DriverRule::note_request(SessionId id, std::uint8_t message) {
  if (!request_rules::drives(message) || driver_ == id) return;
  driver_ = id;
  confirmed_ = false;
}

void DriverRule::note_stop(SessionId id, const PortUser& by) {
  if (driver_ && driver_ != id) stopped_.try_emplace(*driver_, by);
}

void DriverRule::note_answer(SessionId id, std::uint8_t request, bool accepted) {
  using namespace protocol;  // NOLINT(google-build-using-namespace): this function is all messages
  if (request == Arm::kId && accepted) stopped_.erase(id);
  if (request_rules::drives(request) && driver_ == id) {
    confirmed_ = confirmed_ || accepted;
    if (!confirmed_) end_drive();
  }
  const bool disarms = request == Disarm::kId || request == Reboot::kId || request == EnterBootloader::kId;
  if (disarms && accepted) end_drive();
}

void DriverRule::release(SessionId id) {
  if (driver_ == id) end_drive();
}

void DriverRule::remove(SessionId id) {
  release(id);
  stopped_.erase(id);
}

void DriverRule::clear() {
  end_drive();
  stopped_.clear();
}

}  // namespace astro::robot
