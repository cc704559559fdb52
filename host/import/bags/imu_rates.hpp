#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host/base/error.hpp"

/// Reads the rates of rotation that an IMU of the robot measured (sensor_msgs/Imu), in bags of ROS 1 and 2.
namespace astro::importing {

/// About the sensor's own axes x, y, z, in its frame, which need not be the robot's.
struct ImuRate {
  std::int64_t time_ns = 0;
  std::array<double, 3> rate_radps{};
};

struct ImuRates {
  std::string topic;             // "" if the bag has no IMU, or several of which none was named
  std::vector<ImuRate> samples;  // times increase strictly
  std::vector<Remark> remarks;   // what was inferred or left out
};

/// The rates on `topic` or, if it is "", on the only topic of IMUs. Times are header.stamp; if most messages have no stamp, the
/// recorder's times are used for all. Messages that say that they measure no rates (a first covariance of -1), or whose rates are no
/// numbers, are left out with a remark. Without a name a bag with several IMUs gives none, with a remark: a gyro is an extra, and
/// a drive counts without it.
///
/// Errors  UnclearChoice (unclear_choice.hpp) if the named topic has no IMU; astro::Error naming the file if it is not a bag, or has
///         more samples than a file of its size can hold.
ImuRates imu_rates_in_bag(const std::filesystem::path& path, const std::string& topic = {});

}  // namespace astro::importing
