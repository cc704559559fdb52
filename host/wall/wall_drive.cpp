#include "host/wall/wall_drive.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "host/base/interrupted.hpp"
#include "host/calibration/motion/arc.hpp"

namespace astro::wall {

/// What a MoveRecorder takes.
constexpr std::uint32_t kWithGyro =
    protocol::Telemetry::kPose | protocol::Telemetry::kTwist | protocol::Telemetry::kFused;

/// Notices that a robot which follows its set points pushes against something, because for 40 ms a wheel
///   has more voltage than its feed-forward needs for its set point and the steepest acceleration, by more than the push
///   limit; or
///   falls 0.12 m/s behind its set point, which shows better at high speed, where the voltage is near its limit.
/// This limits how long the robot pushes, not how hard, because the control loop may raise the voltage. Without it only the
/// robot itself would notice a stall, at half of its voltage and after 300 ms.
class WallDriver::ObstacleGuard {
 public:
  ObstacleGuard(const WallRobot& robot, double push_V) : robot_(robot), push_V_(push_V) {}

  void look(const WheelMoment& moment);
  bool pushes() const { return pushes_; }

 private:
  static constexpr int kSamples = 4;  // of 10 ms

  bool is_held(const WheelMoment& moment, std::size_t side) const;
  double excess_V(const WheelMoment& moment, std::size_t side) const;

  const WallRobot& robot_;
  double push_V_;
  std::array<int, 2> in_a_row_{};
  bool pushes_ = false;
};

double WallDriver::ObstacleGuard::excess_V(const WheelMoment& moment, std::size_t side) const {
  const double set_point_mps = moment.set_point_mps[side];
  const double usual_V = 2 * robot_.kS_V[side] + robot_.kV_Vspm[side] * std::abs(set_point_mps) +
                         robot_.kA_Vs2pm[side] * robot_.acceleration_mps2;
  return moment.voltage_V[side] * std::copysign(1.0, set_point_mps) - usual_V;
}

bool WallDriver::ObstacleGuard::is_held(const WheelMoment& moment, std::size_t side) const {
  constexpr double kBehind_mps = 0.12;  // more than a wheel lags behind its set point at full acceleration
  const double forward = std::copysign(1.0, moment.set_point_mps[side]);
  return (moment.set_point_mps[side] - moment.speed_mps[side]) * forward > kBehind_mps;
}

void WallDriver::ObstacleGuard::look(const WheelMoment& moment) {
  for (std::size_t side = 0; side < 2; ++side) {
    const bool against = excess_V(moment, side) > push_V_ || is_held(moment, side);
    in_a_row_[side] = against ? in_a_row_[side] + 1 : 0;
    pushes_ = pushes_ || in_a_row_[side] >= kSamples;
  }
}

robot::Path path_of(const Leg& leg, const calibration::WheelFactors& actual,
                    const calibration::WheelFactors& loaded, robot::PathLimits limits) {
  constexpr double kTurn_rad = 2 * std::numbers::pi, kNone_m = 1e-7;
  const double rim_m = leg.turns * kTurn_rad * actual.b_m / 2;
  const double right_m = (leg.ahead_m + rim_m) * loaded.c_r / actual.c_r;
  const double left_m = (leg.ahead_m - rim_m) * loaded.c_l / actual.c_l;
  const double length_m = (right_m + left_m) / 2;
  const double turned =
      (right_m - left_m) / calibration::effective_wheelbase_m(right_m, left_m, loaded) / kTurn_rad;
  if (std::abs(length_m) < kNone_m) return robot::spin(turned, limits);
  return robot::arc(length_m, turned, limits);
}

WallDriver::WallDriver(robot::Client& client, const WallRobot& robot, double push_V, robot::PathLimits limits,
                       Hooks hooks)
    : client_(client),
      robot_(robot),
      push_V_(push_V),
      limits_(limits),
      hooks_(std::move(hooks)),
      watch_(client, robot.count_m, robot.uses_gyro ? kWithGyro : 0) {}

robot::DriveHooks WallDriver::drive_hooks(const ObstacleGuard* guard) const {
  robot::DriveHooks hooks;
  hooks.interrupted = [this, guard] { return hooks_.interrupted() || (guard != nullptr && guard->pushes()); };
  hooks.notice = hooks_.notice;
  return hooks;
}

void WallDriver::drive(std::span<const Leg> legs, const calibration::WheelFactors& actual) {
  robot::Path path;
  for (const Leg& leg : legs) {
    const robot::Path segments = path_of(leg, actual, robot_.loaded, limits_);
    path.insert(path.end(), segments.begin(), segments.end());
  }
  ObstacleGuard guard(robot_, push_V_);
  watch_.seen = [&guard](const WheelMoment& moment) { guard.look(moment); };
  try {
    robot::DriveSession session(client_, drive_hooks(&guard));
    session.run(path);
    session.end();
    watch_.wait_until_wheels_stand();
    watch_.seen = [](const WheelMoment&) {};
  } catch (const Interrupted&) {
    watch_.seen = [](const WheelMoment&) {};
    if (!guard.pushes()) throw;
    throw RanIntoSomething(
        "the robot ran into something on its way, and was stopped" + std::string(kFaceWall),
        WallProblem::not_at_wall);
  } catch (...) {
    watch_.seen = [](const WheelMoment&) {};
    throw;
  }
}

WallDriver::Flush WallDriver::square(double within_m) {
  robot::DriveSession session(client_, drive_hooks(nullptr));
  const Touch touch = square_against_wall(session, watch_, client_, robot_, push_V_, within_m);
  watch_.fresh();
  const Flush flush{watch_.travel(), touch.crept_m};
  session.end();
  return flush;
}

}  // namespace astro::wall
