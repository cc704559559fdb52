#pragma once

#include <cstdint>
#include <optional>

#include "common/protocol/messages.hpp"

namespace astro::protocol {

/// Ends the permission of whoever drives.
constexpr bool stops(std::uint8_t message) {
  return message == Stop::kId || message == Disarm::kId || message == EmergencyStop::kId;
}

/// Who may move the robot, and until when: the rule that makes a stop hold. The robot applies it to the hosts at its
/// ports, and a program that shares its port with others applies it to those programs.
///
///   Arm            makes its sender the driver, and ends a stop or a pause
///   Velocity, WheelVoltage, AddSegment, Rest
///                  are for the driver alone
///   Stop, Disarm, EmergencyStop of anybody
///                  end the driver's permission until an Arm
///   Pause of anybody
///                  suspends it: the driver's segments wait behind the paused path, and all else that moves the robot
///                  is refused, also a Rest, which would end the pause. It ends with a Resume: the driver's own if the
///                  driver paused, or that of any other host; or with an Arm, after which a path waits for Resume all
///                  the same. Nobody resumes the path of a driver that has gone.
///
/// A program that arms several times, one run after another, must hear of a stop that came between two of its runs: it asks
/// for the status before each Arm (Status::stops_by_others), and an Arm of a host that has not asked since is refused.
///
/// A fault needs no row, because it takes an Arm to drive after one.
///
/// `Host` identifies a host and can be compared.
template <class Host>
class DrivingRule {
 public:
  const std::optional<Host>& driver() const { return driver_; }
  bool drives(const Host& host) const { return driver_ == host; }
  /// Somebody has stopped the robot since its driver armed it.
  bool stopped() const { return stopped_; }

  /// Whether this request of this host may be carried out. True for all that do not move the robot.
  bool permits(const Host& from, std::uint8_t message) const {
    switch (message) {
      case Velocity::kId:
      case WheelVoltage::kId:
      case Rest::kId:
        return drives(from) && !stopped_ && !paused_;
      case AddSegment::kId:
        return drives(from) && !stopped_;
      case Resume::kId:
        return driver_ && (!drives(from) || (!stopped_ && !paused_by_other_));
      default:
        return true;
    }
  }

  /// The request was carried out.
  void note(const Host& from, std::uint8_t message) {
    stopped_ = stopped_ || stops(message);
    switch (message) {
      case Arm::kId:
        driver_ = from;
        stopped_ = paused_ = paused_by_other_ = false;
        return;
      case Pause::kId:
        paused_ = true;
        paused_by_other_ = paused_by_other_ || !drives(from);
        return;
      case Resume::kId:
        paused_ = paused_by_other_ = false;
        return;
      default:
        return;
    }
  }

  /// The driver has gone: nobody may move the robot until somebody arms it.
  void end() { driver_.reset(); }

 private:
  std::optional<Host> driver_;
  bool stopped_ = false;
  bool paused_ = false, paused_by_other_ = false;
};

}  // namespace astro::protocol
