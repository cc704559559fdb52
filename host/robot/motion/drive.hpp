#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/interrupted.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/client/refusal.hpp"
#include "host/robot/motion/arming.hpp"

namespace astro::robot {

/// The robot did not confirm that it is at rest and disarmed after a stop request: it may still move. Its kind is that of
/// the error that occurred, or DriveProblem::stop_unconfirmed if that error has none.
class NotStopped : public Error {
 public:
  using Error::Error;
};

struct DriveHooks {
  /// Called at least every 50 ms while the robot drives; true stops and disarms the robot and ends the drive
  /// with Interrupted. For the flag that Ctrl-C sets. Not called while the robot ramps to rest, which ends by
  /// itself; `resting` is.
  std::function<bool()> interrupted = [] { return false; };
  /// Called at least every 50 ms while the robot ramps to rest, by stop() or end(). It may ask the robot something itself: an
  /// emergency stop must not wait for the end of a ramp.
  std::function<void()> resting = [] {};
  /// Called with remarks that are worth showing but are not errors.
  std::function<void(const Remark&)> notice = [](const Remark&) {};
  /// Called for each segment that was driven to its end; tags count from 1 in the order of the run.
  std::function<void(const protocol::SegmentDone&)> segment_done = [](const protocol::SegmentDone&) {};
};

/// An armed robot. At the end of the scope it is brought to rest and disarmed, however the scope is left,
/// unless the link is lost. After a finished drive call end(), which throws if the robot did not confirm it.
/// The destructor cannot throw; it only sends a notice.
///
/// Errors  DriveFault: a fault was latched; Interrupted; NotStopped: as Interrupted, but the robot did not
///         confirm that it stopped; LinkLost, also for a robot that restarted; Error if another program
///         stopped or disarmed the robot, which it names where it knows it; all that Client::request throws.
class DriveSession {
 public:
  /// Arms the robot. First clears what an earlier drive left behind (clear_faults_left_behind) and reports that in a notice. Throws Error, and changes nothing on the robot, if the robot
  /// stays armed for another program, or if another program has stopped it since this one drove.
  explicit DriveSession(Client& client, DriveHooks hooks = {});
  DriveSession(const DriveSession&) = delete;
  DriveSession& operator=(const DriveSession&) = delete;
  ~DriveSession();

  /// Drives the segments one after the other and returns when the last has ended. Keeps the robot's queue as
  /// full as possible and numbers the segments. If an event was lost, it asks for the robot's status instead.
  void run(std::span<const protocol::AddSegment> segments);

  /// Sends one velocity; it holds until the robot's command time-out.
  void set_velocity(double v_mps, double omega_radps);

  /// Sends voltages for the motors, open loop, forward positive; they hold until the robot's command
  /// time-out. Only from rest, or after other voltages.
  void set_wheel_voltages(double left_V, double right_V);

  /// As Client::pump, and throws as run() does.
  void pump(microseconds duration);

  /// Ramps to rest, empties the queue and returns when the robot is at rest; more motion may follow. Throws if somebody else
  /// has stopped the robot.
  void stop();

  /// Ramps to rest and disarms; the drive is over, and nothing else may be called. Throws NotStopped if the
  /// robot does not confirm both, DriveFault if a fault was latched on the way.
  void end();

 private:
  protocol::Status status_unless_stopped();
  void wait_until_free();
  void arm();
  bool add(const protocol::AddSegment& segment);
  void wait_for_progress();
  void ask_for_progress();
  void check();
  void wait_until_power_off();
  void rest_and_disarm();
  template <protocol::Request M>
  void command(const M& motion);
  void explain(const RobotRefused& refused);
  [[noreturn]] void fail(Fault fault);
  [[noreturn]] void fail_ended(const std::string& done_to_robot, std::uint16_t aborted = 0);
  [[noreturn]] void fail_busy(protocol::Mode mode);

  Client& client_;
  DriveHooks hooks_;
  std::optional<Fault> fault_;
  bool booted_ = false;
  bool stopping_ = false;
  bool ended_ = false;                                   // end() was called, successfully or not
  std::uint16_t accepted_ = 0, done_ = 0, aborted_ = 0;  // tags of the run under way
  Subscription on_done_, on_fault_, on_boot_;
};

}  // namespace astro::robot
