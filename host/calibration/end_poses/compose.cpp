#include "host/calibration/end_poses/compose.hpp"

#include <cmath>

#include "host/base/error.hpp"

namespace astro::calibration {

WheelFactors compose(const WheelFactors& carried, double E_d, double E_b) {
  const double ratio = E_d * carried.c_r / carried.c_l;
  const double sum = carried.c_r + carried.c_l;
  return {sum * ratio / (1 + ratio), sum / (1 + ratio), E_b * carried.b_m};
}

void require_usable(const WheelFactors& carried) {
  const auto usable = [](double value) { return std::isfinite(value) && value > 0; };
  if (!usable(carried.b_m)) {
    throw Error("the wheelbase that the robot carried is " + std::to_string(carried.b_m) +
                " m: give the distance between the wheels in metres, such as 0.29");
  }
  if (!usable(carried.c_r) || !usable(carried.c_l)) {
    throw Error("the wheel factors that the robot carried are c_R = " + std::to_string(carried.c_r) +
                " and c_L = " + std::to_string(carried.c_l) +
                ": give positive ratios, 1 for a nominal wheel");
  }
}

}  // namespace astro::calibration
