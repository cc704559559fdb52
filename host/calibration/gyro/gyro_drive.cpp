#include "host/calibration/gyro/gyro_drive.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/order_statistics.hpp"
#include "host/calibration/motion/arc.hpp"
#include "host/calibration/motion/wheel_path.hpp"

namespace astro::calibration {

GyroPath::GyroPath(std::span<const YawRate> rates) {
  constexpr double kLeastGap_s = 0.1, kGapPeriods = 5;
  if (rates.size() < 2) return;
  const double gap_s = std::max(kLeastGap_s, kGapPeriods * median_period_s(rates));
  double turn_rad = 0;
  int piece = 0;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (i > 0) {
      const double dt_s = rates[i].time_s - rates[i - 1].time_s;
      if (dt_s > gap_s) ++piece;
      turn_rad += rates[i].rate_radps * dt_s;
    }
    times_s_.push_back(rates[i].time_s);
    turns_rad_.push_back(turn_rad);
    pieces_.push_back(piece);
  }
}

GyroPath::Place GyroPath::at(double time_s) const {
  if (times_s_.empty() || !(time_s >= times_s_.front()) || !(time_s <= times_s_.back())) return {};
  const std::size_t i =
      interval_near(last_, std::span<const double>(times_s_), time_s, [](double time) { return time; });
  const double span_s = times_s_[i + 1] - times_s_[i];
  const double part = span_s > 0 ? (time_s - times_s_[i]) / span_s : 0;
  return {turns_rad_[i] + part * (turns_rad_[i + 1] - turns_rad_[i]), pieces_[i],
          pieces_[i] == pieces_[i + 1]};
}

std::vector<WheelTurn> wheel_turns(std::span<const WheelSample> wheels, const WheelFactors& factors) {
  constexpr double kHalfWindow_s = 0.02, kChange_s = 0.15;
  std::vector<WheelTurn> turns;
  turns.reserve(wheels.size());
  WheelTurn now;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    now.time_s = wheels[i].time_s;
    if (i > 0) {
      const double right_m = wheels[i].right_m - wheels[i - 1].right_m,
                   left_m = wheels[i].left_m - wheels[i - 1].left_m;
      advance(now.pose, right_m, left_m, factors);
      now.way_m += (factors.c_r * right_m + factors.c_l * left_m) / 2;
      now.path_m += std::abs(right_m) + std::abs(left_m);
    }
    turns.push_back(now);
  }
  std::size_t from = 0, to = 0;
  for (WheelTurn& turn : turns) {
    while (turns[from + 1].time_s <= turn.time_s - kHalfWindow_s) ++from;
    while (to + 1 < turns.size() && turns[to].time_s < turn.time_s + kHalfWindow_s) ++to;
    const double span_s = turns[to].time_s - turns[from].time_s;
    if (span_s > 0) turn.rate_radps = (turns[to].pose.theta_rad - turns[from].pose.theta_rad) / span_s;
  }
  std::size_t before = 0, after = 0;
  for (WheelTurn& turn : turns) {
    while (before + 1 < turns.size() && turns[before + 1].time_s <= turn.time_s - kChange_s) ++before;
    while (after + 1 < turns.size() && turns[after].time_s < turn.time_s + kChange_s) ++after;
    turn.change_radps = std::max(std::abs(turns[after].rate_radps - turn.rate_radps),
                                 std::abs(turn.rate_radps - turns[before].rate_radps));
  }
  return turns;
}

}  // namespace astro::calibration
