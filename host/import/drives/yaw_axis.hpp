#pragma once

#include <array>
#include <optional>
#include <vector>

#include "host/import/bags/imu_rates.hpp"
#include "host/recording/run.hpp"

namespace astro::importing {

/// From the rates about an IMU's own axes to the yaw rate of the robot. The axis that is stated counts; otherwise the one whose rate
/// follows the wheels' best, whose direction the wheels show as well. The IMU may lag behind them by up to 0.4 s.
///
/// Takes the samples. A remark says which axis it is, or that the drive does not turn enough to show one; then there are no rates.
/// Precondition: the odometry is in order of time.
std::vector<recording::YawRate> yaw_rates_of(ImuRates rates,
                                             const std::vector<recording::OdometrySample>& odometry,
                                             const std::optional<std::array<double, 3>>& stated,
                                             std::vector<Remark>& remarks);

}  // namespace astro::importing
