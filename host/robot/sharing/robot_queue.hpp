#pragma once

#include <cstdint>

#include "host/robot/sharing/exchange.hpp"
#include "host/robot/sharing/frame_queue.hpp"

namespace astro::robot {

/// Requests that wait for the line to the robot.
///
/// Ids     a request gets an id when it is first sent, and keeps it when it is sent again. Bit 15 is clear in
///         the driver's and set in all others.
/// Order   Stop, EmergencyStop and Disarm overtake all frames that have not begun, and withdraw the requests
///         for motion among them. All others keep their order, Pause as well: it must come after the Arm or
///         Resume that was sent before it.
/// Bounds  a request is dropped if 256 frames wait already, a stop or a pause if 512 do. Fewer wait even if
///         all programs ask at the same time, so a full queue means that the line itself has stopped.
class RobotQueue {
 public:
  void send(Exchange& exchange, bool drivers, microseconds now);

  /// To be written.
  FrameQueue& frames() { return frames_; }

 private:
  std::uint16_t fresh_id(bool drivers);

  FrameQueue frames_;
  std::uint16_t last_id_ = 0;
};

}  // namespace astro::robot
