#include "host/experiment/wall/wall_drive.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "host/base/interrupted.hpp"
#include "host/calibration/motion/arc.hpp"

namespace astro::experiment {

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
      watch_(client, robot.count_m) {}

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
    throw RanIntoSomething("the robot ran into something on its way, and was stopped",
                           {Help::face_wall_and_resume});
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

}  // namespace astro::experiment
