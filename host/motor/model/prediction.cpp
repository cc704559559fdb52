#include "host/motor/model/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace astro::motor {
namespace {

class Wheel {
 public:
  explicit Wheel(const WheelLoop& loop)
      : loop_(loop), decay_(std::exp(-loop.tick_s / loop.motor.time_constant_s())) {}

  void advance(double voltage_V) {
    if (speed_mps_ == 0 && std::abs(voltage_V) <= std::max(loop_.breakaway_V, loop_.motor.kS)) return;
    const double sense = speed_mps_ != 0 ? speed_mps_ : voltage_V;
    const double end_mps = (voltage_V - std::copysign(loop_.motor.kS, sense)) / loop_.motor.kV;
    const double before_mps = speed_mps_;
    speed_mps_ = end_mps + (before_mps - end_mps) * decay_;
    if (speed_mps_ * sense < 0) speed_mps_ = 0;  // friction holds a wheel that has stopped
    position_m_ += (before_mps + speed_mps_) / 2 * loop_.tick_s;
  }
  double speed_mps() const { return speed_mps_; }
  double counts() const { return std::floor(position_m_ / loop_.count_m + 0.5); }

 private:
  const WheelLoop& loop_;
  double decay_, speed_mps_ = 0, position_m_ = 0;
};

class Observer {
 public:
  Observer(double bandwidth_radps, double tick_s) : a_(bandwidth_radps * tick_s) {}

  /// `expected`: the commanded change of speed, in counts per tick.
  void advance(double counts, double expected) {
    constexpr double kLargestExpected = 0.25;
    speed_ += std::clamp(expected, -kLargestExpected, kLargestExpected);
    error_ += counts - speed_;
    speed_ += a_ * a_ * error_;
    error_ -= (2 * a_ - a_ * a_) * error_;
  }
  double counts_per_tick() const { return speed_; }

 private:
  double a_, error_ = 0, speed_ = 0;
};

class Controller {
 public:
  explicit Controller(const WheelLoop& loop) : loop_(loop) {}

  double advance(double wanted_mps, double acceleration_mps2, double observed_mps) {
    constexpr double kFadeIn_mps = 8.192e-3;  // of kS, as in the firmware
    constexpr double kShare_ps =
        65e3 / 65536;  // rate at which set points shrink if the voltage reaches its limit
    const MotorModel& forward = loop_.feed_forward;
    const double set_point_mps = share_ * wanted_mps;
    const double error = set_point_mps - observed_mps;
    const double wanted_V = forward.kS * std::clamp(set_point_mps / kFadeIn_mps, -1.0, 1.0) +
                            forward.kV * set_point_mps + forward.kA * acceleration_mps2 + loop_.kp * error +
                            integral_V_;
    const double given_V = std::clamp(wanted_V, -loop_.limit_V, loop_.limit_V);
    const bool limited = given_V != wanted_V;
    if (limited) integral_V_ = std::clamp(integral_V_, -loop_.limit_V, loop_.limit_V);
    if (!limited || error * given_V < 0) integral_V_ += loop_.ki * error * loop_.tick_s;
    share_ = std::clamp(share_ + (limited ? -kShare_ps : kShare_ps) * loop_.tick_s, 0.0, 1.0);
    return given_V;
  }

 private:
  const WheelLoop& loop_;
  double integral_V_ = 0, share_ = 1;
};

/// When the speed first reaches a level; NaN if it never does.
double time_of(std::span<const double> time_s, std::span<const double> speed_mps, double level_mps) {
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (speed_mps[i] * level_mps <= 0 || std::abs(speed_mps[i]) < std::abs(level_mps)) continue;
    if (i == 0) return time_s[0];
    const double part = (level_mps - speed_mps[i - 1]) / (speed_mps[i] - speed_mps[i - 1]);
    return time_s[i - 1] + part * (time_s[i] - time_s[i - 1]);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<Predicted> predict(const WheelLoop& loop, std::span<const double> set_points_mps) {
  std::vector<Predicted> course;
  course.reserve(set_points_mps.size());
  Wheel wheel(loop);
  Observer observer(loop.observer_radps, loop.tick_s);
  Controller controller(loop);
  double counts = 0, before_mps = 0, expected = 0;
  for (const double set_point_mps : set_points_mps) {
    const double seen = wheel.counts();
    observer.advance(seen - counts, expected);
    counts = seen;
    const double observed_mps = observer.counts_per_tick() * loop.count_m / loop.tick_s;
    const double acceleration_mps2 = (set_point_mps - before_mps) / loop.tick_s;
    const double voltage_V = controller.advance(set_point_mps, acceleration_mps2, observed_mps);
    course.push_back({set_point_mps, observed_mps, wheel.speed_mps(), voltage_V});
    wheel.advance(voltage_V);
    expected = acceleration_mps2 * loop.tick_s * loop.tick_s / loop.count_m;
    before_mps = set_point_mps;
  }
  return course;
}

StepFigures step_figures(std::span<const double> time_s, std::span<const double> set_point_mps,
                         std::span<const double> speed_mps) {
  StepFigures figures;
  if (time_s.empty()) return figures;
  const double goal_mps = set_point_mps.back();
  figures.rise_s = time_of(time_s, speed_mps, 0.9 * goal_mps) - time_of(time_s, speed_mps, 0.1 * goal_mps);
  double squares = 0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double error_mps = speed_mps[i] - set_point_mps[i];
    squares += error_mps * error_mps;
    figures.worst_error_mps = std::max(figures.worst_error_mps, std::abs(error_mps));
    figures.overshoot = std::max(figures.overshoot, speed_mps[i] / goal_mps - 1);
  }
  figures.rms_error_mps = std::sqrt(squares / static_cast<double>(time_s.size()));
  return figures;
}

}  // namespace astro::motor
