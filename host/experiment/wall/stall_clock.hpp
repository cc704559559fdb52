#pragma once

#include <array>

#include "host/experiment/wall/wheel_watch.hpp"

namespace astro::experiment {

/// For how long each wheel has stood although its motor had voltage; left, right. A wheel that moves by less than two counts and a half
/// in a tenth of a second stands: slower than 1 mm/s it cannot make more. Its speed would not show that, because a count now and then
/// looks like a wheel that turns.
class StallClock {
 public:
  explicit StallClock(double count_m) : still_m_(2.5 * count_m) {}

  /// Each sample of telemetry, in order.
  void look(const WheelMoment& moment, const calibration::WheelTravel& travel) {
    const double step_s = last_us_ == 0 ? 0 : 1e-6 * static_cast<double>(moment.time_us - last_us_);
    last_us_ = moment.time_us;
    note(0, moment.voltage_V[0], travel.left_m, step_s);
    note(1, moment.voltage_V[1], travel.right_m, step_s);
  }

  double stood_s(std::size_t side) const { return stood_s_[side]; }
  double longest_s() const { return stood_s_[0] > stood_s_[1] ? stood_s_[0] : stood_s_[1]; }

 private:
  static constexpr std::size_t kSamples = 10;  // of 10 ms
  static constexpr double kVoltage_V = 0.05;   // less is none

  void note(std::size_t side, double voltage_V, double at_m, double step_s) {
    std::array<double, kSamples>& was_at_m = was_at_m_[side];
    const double moved_m = at_m - was_at_m[next_ % kSamples];
    was_at_m[next_ % kSamples] = at_m;
    if (side == 1) ++next_;
    const bool stands = voltage_V > kVoltage_V && moved_m < still_m_ && moved_m > -still_m_;
    stood_s_[side] = stands ? stood_s_[side] + step_s : 0;
  }

  double still_m_;
  std::uint64_t last_us_ = 0;
  std::size_t next_ = 0;
  std::array<std::array<double, kSamples>, 2> was_at_m_{};
  std::array<double, 2> stood_s_{};
};

}  // namespace astro::experiment
