#include "host/robot/motion/drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/base/text/numbers.hpp"
#include "host/robot/client/restore.hpp"
#include "host/robot/client/robot_problem.hpp"
#include "host/robot/motion/drive_problem.hpp"
#include "host/robot/motion/other_program.hpp"
#include "host/robot/motion/rest.hpp"

namespace astro::robot {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages
using std::chrono::milliseconds;

namespace {

constexpr microseconds kPoll =
    milliseconds(1000);  // an event must have been lost by then, or the segment is long
constexpr microseconds kRestPoll = milliseconds(50);
constexpr microseconds kAsk = milliseconds(50);  // period at which the hooks are asked
constexpr microseconds kTimeToNotice =
    milliseconds(4000);  // an armed robot waits 2.5 s for its host; one that drives ramps to rest
constexpr std::size_t kMostSegments = 0xFFFF;

std::int32_t micro(double value, const char* what) {
  const double steps = std::round(value * 1e6);
  if (!(std::abs(steps) <= 0x7FFFFFFF))
    throw Error(std::string(what) + " of " + to_text(value) + " is not possible",
                PathProblem::impossible_number, {what, to_text(value)});
  return static_cast<std::int32_t>(steps);
}

}  // namespace

DriveSession::DriveSession(Client& client, DriveHooks hooks) : client_(client), hooks_(std::move(hooks)) {
  on_done_ = client_.on<SegmentDone>([this](const SegmentDone& done) {
    done_ = std::max(done_, done.tag);
    if (done.outcome != SegmentOutcome::aborted) return hooks_.segment_done(done);
    if (aborted_ == 0) aborted_ = done.tag;  // segments that waited behind it are aborted, too
  });
  on_fault_ = client_.on<FaultRaised>([this](const FaultRaised& raised) {
    if (!fault_) fault_ = raised.fault;
  });
  on_boot_ = client_.on<Booted>([this](const Booted&) { booted_ = true; });
  wait_until_free();
  arm();
}

DriveSession::~DriveSession() {
  if (ended_) return;
  try {
    end();
  } catch (const NotStopped& error) {
    try {
      hooks_.notice(error.remark());
    } catch (const std::exception&) {  // nobody can be notified
    }
  } catch (const std::exception&) {  // a fault, by which the robot has switched its motors off
  }
}

void DriveSession::end() {
  ended_ = true;
  try {
    rest_and_disarm();
  } catch (const std::exception& error) {
    const auto* known = dynamic_cast<const Error*>(&error);
    Remark why = known == nullptr ? Remark{error.what()} : known->remark();
    if (why.kind == Kind()) why.kind = DriveProblem::stop_unconfirmed;
    throw NotStopped(why.in("the robot did not confirm that it stopped, and may still be moving: "));
  }
  if (fault_) fail(*fault_);
}

/// A robot that does not come to rest by its ramp is disarmed anyway, which opens its bridges.
void DriveSession::rest_and_disarm() {
  try {
    const Restore stopping(stopping_, true);
    client_.request(Stop{});
    wait_until_power_off();
  } catch (const LinkLost&) {
    throw;  // it cannot be disarmed either
  } catch (const std::exception&) {
    client_.request(Disarm{});
    throw;
  }
  client_.request(Disarm{});
}

/// A stop between two drives of this program also holds for the next one.
Status DriveSession::status_unless_stopped() {
  const Status status = client_.request(GetStatus{});
  if (!client_.learns_of_stop(status)) return status;
  Remark stopped = stopped_by_another(port_users(client_));
  stopped.sentence += " since this one drove it last: start again once it may drive";
  throw Error(stopped);
}

/// A program that was killed leaves an armed robot behind, until the robot's time-out ends that.
void DriveSession::wait_until_free() {
  const microseconds deadline = client_.now() + kTimeToNotice;
  while (true) {
    const Mode mode = status_unless_stopped().mode;
    if (mode == Mode::disarmed || mode == Mode::fault) return;
    if (client_.now() >= deadline) fail_busy(mode);
    client_.pump(kRestPoll);
  }
}

void DriveSession::arm() {
  if (const auto cleared = clear_faults_left_behind(client_, [this] { wait_until_power_off(); }))
    hooks_.notice(*cleared);
  fault_.reset();
  status_unless_stopped();  // checked last, directly before Arm
  command(Arm{});
}

void DriveSession::run(std::span<const AddSegment> segments) {
  if (segments.size() > kMostSegments) throw Error("a path of more than 65535 segments is not possible");
  accepted_ = done_ = aborted_ = 0;
  for (AddSegment segment : segments) {
    segment.tag = static_cast<std::uint16_t>(accepted_ + 1);
    while (!add(segment)) wait_for_progress();
    accepted_ = segment.tag;
  }
  while (done_ < accepted_) wait_for_progress();
  check();
}

bool DriveSession::add(const AddSegment& segment) {
  check();
  try {
    command(segment);
    return true;
  } catch (const RobotRefused& refused) {
    if (refused.code() != ErrorCode::queue_full) throw;
    return false;
  }
}

void DriveSession::wait_for_progress() {
  const std::uint16_t before = done_;
  const auto something = [&] { return done_ != before || fault_ || booted_ || hooks_.interrupted(); };
  const microseconds deadline = client_.now() + kPoll;
  bool happened = false;
  while (!happened && client_.now() < deadline) happened = client_.pump_until(something, kAsk);
  check();
  if (!happened) ask_for_progress();
}

void DriveSession::ask_for_progress() {
  const Status status = client_.request(GetStatus{});
  if (status.latched_faults != 0) fail(first_fault(status.latched_faults));
  if (status.mode == Mode::disarmed) fail_ended("disarmed");
  const bool idle = status.mode == Mode::idle && status.queued_segments == 0;
  if (idle) {
    command(Rest{});  // refused if somebody has stopped the robot
    done_ = accepted_;
  }
  check();
}

void DriveSession::check() {
  if (fault_) fail(*fault_);
  if (booted_) throw LinkLost("the robot at " + client_.name() + " has restarted: the drive is lost");
  if (aborted_ != 0 && !stopping_) fail_ended("stopped", aborted_);
  if (!stopping_ && hooks_.interrupted()) {
    end();
    throw Interrupted("stopped: the robot is at rest and disarmed");
  }
}

void DriveSession::set_velocity(double v_mps, double omega_radps) {
  check();
  command(Velocity{micro(v_mps, "a speed in m/s"), micro(omega_radps, "a yaw rate in rad/s")});
}

void DriveSession::set_wheel_voltages(double left_V, double right_V) {
  check();
  const auto milli = [](double volts) { return static_cast<std::int32_t>(std::lround(1e3 * volts)); };
  command(WheelVoltage{milli(left_V), milli(right_V)});
}

void DriveSession::pump(microseconds duration) {
  client_.pump_until([&] { return fault_ || booted_ || hooks_.interrupted(); }, duration);
  check();
}

void DriveSession::stop() {
  const Restore stopping(stopping_, true);
  command(Rest{});
  wait_until_power_off();
  aborted_ = 0;  // this stop caused the abort
}

void DriveSession::wait_until_power_off() {
  if (robot::wait_until_power_off(client_, hooks_.resting)) return;
  throw Error("the robot did not come to rest and was disarmed: its motors are off, but it may roll on");
}

template <Request M>
void DriveSession::command(const M& motion) {
  try {
    client_.request(motion);
  } catch (const RobotRefused& refused) {
    explain(refused);
    throw;
  }
}

void DriveSession::explain(const RobotRefused& refused) {
  if (refused.code() == ErrorCode::faulted) fail(static_cast<Fault>(refused.detail()));
  if (refused.code() == ErrorCode::not_armed) {
    const bool paused = client_.request(GetStatus{}).mode == Mode::paused;
    fail_ended(paused ? "paused" : "stopped");
  }
  if (const Remark why = why_refused(client_, refused); why.kind == DriveProblem::driven_by_another)
    throw Error(why);
}

/// Without a command time-out a robot whose driver was killed stays armed.
void DriveSession::fail_busy(Mode mode) {
  const PortUsers users = port_users(client_);
  if (mode != Mode::idle || users.driver_pid != 0) throw Error(driven_by_another(users));
  throw Error("the robot stands and is armed, for another program or for one that has gone",
              DriveProblem::armed_for_another);
}

/// The reason may arrive after the end: after a fault the robot reports the aborted segment first.
void DriveSession::fail_ended(const std::string& done_to_robot, std::uint16_t aborted) {
  client_.learns_of_stop(client_.request(GetStatus{}));  // the error below reports the stop
  const FaultReport report = client_.request(GetFaults{});
  if (report.latched != 0) fail(report.first != Fault::none ? report.first : first_fault(report.latched));
  const PortUsers users = port_users(client_);
  const std::string segment = std::to_string(aborted);
  throw Error(
      (aborted != 0 ? "segment " + segment + " was aborted: " : "the drive ended early: ") +
          another_program(users.stopper_pid, users.stopper_command) + " " + done_to_robot + " the robot",
      aborted != 0 ? DriveProblem::segment_aborted : DriveProblem::ended_early,
      with_program({aborted != 0 ? segment : done_to_robot}, users.stopper_pid, users.stopper_command));
}

void DriveSession::fail(Fault fault) {
  const std::string named(name(fault));
  if (fault != Fault::emergency_stop)
    throw DriveFault("the robot stopped by itself: " + named, fault, {named});
  const PortUsers users = port_users(client_);
  throw DriveFault(another_program(users.stopper_pid, users.stopper_command) + " stopped the robot: " + named,
                   fault, with_program({named}, users.stopper_pid, users.stopper_command));
}

}  // namespace astro::robot
