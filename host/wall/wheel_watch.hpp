#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "host/robot/client/client.hpp"
#include "host/wall/drive_against_wall.hpp"

namespace astro::wall {

/// The wheels at a moment; left, right.
struct WheelMoment {
  std::uint64_t time_us = 0;  // robot's clock
  std::array<double, 2> speed_mps{}, set_point_mps{}, voltage_V{};
};

/// Follows a robot's wheels by its telemetry, every 10 ms: their newest state, and their travel since the watch began. A lost
/// sample loses no travel, because counts are running totals.
///
/// Errors  LinkLost if no telemetry comes.
class WheelWatch {
 public:
  /// `more`: groups of telemetry that others look at.
  WheelWatch(robot::Client& client, double count_m, std::uint32_t more = 0);
  ~WheelWatch();
  WheelWatch(const WheelWatch&) = delete;
  WheelWatch& operator=(const WheelWatch&) = delete;

  const WheelMoment& now() const { return now_; }
  const WheelTravel& travel() const { return travel_; }

  /// Called with each sample.
  std::function<void(const WheelMoment&)> seen = [](const WheelMoment&) {};

  /// Waits for a sample that the robot took after this call.
  const WheelMoment& fresh();
  /// Waits until the wheels have stood for 0.3 s, which ends within two seconds of any drive.
  void wait_until_wheels_stand();

 private:
  void take(const protocol::Telemetry& telemetry);

  robot::Client& client_;
  double count_m_;
  bool began_ = false;
  std::array<std::int32_t, 2> counts_{};
  WheelMoment now_;
  std::uint64_t moved_us_ = 0;  // when a wheel last counted
  WheelTravel travel_;
  robot::Subscription subscription_;
};

}  // namespace astro::wall
