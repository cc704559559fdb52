#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "common/params/parameter_set.hpp"
#include "common/protocol/messages.hpp"
#include "firmware/app/tick/drive.hpp"

namespace astro::support {

/// Checks from outside that a stop holds: it sees which requests the robot took, in their order, and its mode after every
/// millisecond, and whether the reference of its path rests. It goes through the list of what came since the last Arm each time, where the firmware keeps flags.
class HaltWitness {
 public:
  struct Host {
    int port = -1;
    bool onlooker = false;
    bool operator==(const Host&) const = default;
  };

  static bool is_motion(std::uint8_t message) {
    using namespace protocol;  // NOLINT(google-build-using-namespace): this function is all messages
    return message == Velocity::kId || message == WheelVoltage::kId || message == AddSegment::kId ||
           message == Rest::kId || message == Resume::kId;
  }

  /// The robot has answered a request.
  void answered(const Host& from, std::uint8_t message, bool taken) {
    if (message == protocol::Hello::kId && !from.onlooker && from.port == driver_.port) driver_ = {};
    if (!taken) return;
    if (is_motion(message) && !may(from, message))
      violation_ = "a motion request of a host that may not drive was taken";
    if (message == protocol::Arm::kId) {
      driver_ = from;
      since_.clear();
    }
    using namespace protocol;  // NOLINT(google-build-using-namespace): this function is all messages
    for (const std::uint8_t kept : {Stop::kId, Disarm::kId, EmergencyStop::kId, Pause::kId, Resume::kId})
      if (message == kept) since_.push_back({from, message});
    if (message == Arm::kId || message == Pause::kId || message == Resume::kId) rested_ = false;
  }

  /// After every millisecond. `set`: the robot's parameters, whose limits say how long a ramp may take.
  void look(const Drive& drive, const ParameterSet& set) {
    using protocol::Mode;
    const Mode mode = drive.mode();
    const bool on_path = mode == Mode::segment;
    const bool drives = on_path || mode == Mode::velocity || mode == Mode::wheels;
    // A path that is paused ramps down in its own mode, and in no more time than a ramp takes. Then the reference rests, and the
    // robot has a little time to come to it.
    const bool arrived = drive.follower().arrived();
    pausing_ms_ = paused() && on_path ? pausing_ms_ + 1 : 0;
    settling_ms_ = pausing_ms_ > 0 && arrived ? settling_ms_ + 1 : 0;
    const bool in_time = arrived ? settling_ms_ <= kSettles_ms : pausing_ms_ <= longest_ramp_ms(set);
    const bool may_still_ramp = on_path && !rested_ && in_time;
    if (drives && (stopped() || (paused() && !may_still_ramp)) && violation_.empty())
      violation_ = "the robot drives after a halt that nobody has lifted";
    rested_ = rested_ || !drives;
  }

  bool halted() const { return stopped() || paused(); }
  /// Who has armed the robot last.
  const Host& driver() const { return driver_; }
  /// Empty if nothing was violated.
  const std::string& violation() const { return violation_; }

 private:
  struct Request {
    Host from;
    std::uint8_t message = 0;
  };

  // The firmware gives up after 700 ms, and ends a segment at the boundary of ten ticks.
  static constexpr int kSettles_ms = 710;

  /// From top speed to rest. A ramp that begins while the robot still speeds up takes that back first, so both of its rounded
  /// ends and one more count.
  static int longest_ramp_ms(const ParameterSet& set) {
    const auto ramp_s = [](double speed, double acceleration, double jerk) {
      return speed / acceleration + (jerk > 0 ? 2 * acceleration / jerk : 0);
    };
    const double along_s =
        ramp_s(1e-6 * set.get(Param::speed_limit), 1e-6 * set.get(Param::acceleration_limit),
               1e-3 * set.get(Param::jerk_limit));
    const double around_s =
        ramp_s(1e-6 * set.get(Param::yaw_rate_limit), 1e-6 * set.get(Param::yaw_acceleration_limit),
               1e-3 * set.get(Param::yaw_jerk_limit));
    return static_cast<int>(1000 * std::max(along_s, around_s)) + 50;
  }

  bool stopped() const {
    for (const Request& each : since_)
      if (each.message == protocol::Stop::kId || each.message == protocol::Disarm::kId ||
          each.message == protocol::EmergencyStop::kId)
        return true;
    return false;
  }
  /// The pauses since the last Resume.
  std::vector<Request> pauses() const {
    std::vector<Request> found;
    for (const Request& each : since_) {
      if (each.message == protocol::Resume::kId) found.clear();
      if (each.message == protocol::Pause::kId) found.push_back(each);
    }
    return found;
  }
  bool paused() const { return !pauses().empty(); }
  bool paused_by_another() const {
    for (const Request& each : pauses())
      if (each.from != driver_) return true;
    return false;
  }

  bool may(const Host& from, std::uint8_t message) const {
    if (message == protocol::Resume::kId)
      return driver_ != Host{} && (from != driver_ || (!stopped() && !paused_by_another()));
    if (from != driver_ || stopped()) return false;
    return !paused() || message == protocol::AddSegment::kId;
  }

  Host driver_;
  std::vector<Request> since_;  // halts and Resumes that were taken since the last Arm, the oldest first
  bool rested_ = false;         // since the last Arm, Pause or Resume the robot has been seen not to drive
  int pausing_ms_ = 0;          // for how long it has been on a path that is paused
  int settling_ms_ = 0;         // of that, since its reference rests
  std::string violation_;
};

}  // namespace astro::support
