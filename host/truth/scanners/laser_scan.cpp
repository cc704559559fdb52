#include "host/truth/scanners/laser_scan.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace astro::truth {
namespace {

using ros2::msg::LaserScan;

/// No scanner has more beams or sees beyond a turn.
bool can_be(const LaserScan& message) {
  constexpr std::size_t kMostBeams = 100'000;
  constexpr float kTurn_rad = 2.01F * std::numbers::pi_v<float>;  // rounded
  return std::abs(message.angle_min) <= kTurn_rad && std::abs(message.angle_increment) <= kTurn_rad &&
         message.angle_increment != 0 && message.ranges.size() <= kMostBeams;
}

}  // namespace

std::optional<lidar::Scan> scan_in(LaserScan&& message) {
  if (!can_be(message)) return std::nullopt;
  constexpr double kLongest_s =
      1;  // a scan that takes longer is none of a robot that drives: a driver gave another unit
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const double takes_s =
      static_cast<double>(message.time_increment) * static_cast<double>(message.ranges.size());
  const bool timed = takes_s > 0 && takes_s < kLongest_s;
  const auto& stamp = message.header.stamp;
  return lidar::Scan{
      kSecond_ns * static_cast<std::int64_t>(stamp.sec) + static_cast<std::int64_t>(stamp.nanosec),
      message.angle_min,
      message.angle_increment,
      timed ? static_cast<double>(message.time_increment) : 0,
      message.range_min,
      message.range_max,
      std::move(message.ranges)};
}

}  // namespace astro::truth
