#include "host/calibration/end_poses/compose.hpp"

#include <cmath>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/calibration/end_poses/end_pose_problem.hpp"

namespace astro::calibration {

WheelFactors compose(const WheelFactors& loaded, double E_d, double E_b) {
  const double ratio = E_d * loaded.c_r / loaded.c_l;
  const double sum = loaded.c_r + loaded.c_l;
  return {sum * ratio / (1 + ratio), sum / (1 + ratio), E_b * loaded.b_m};
}

void require_usable(const WheelFactors& loaded) {
  const auto usable = [](double value) { return std::isfinite(value) && value > 0; };
  if (!usable(loaded.b_m)) {
    throw Error("the loaded wheelbase is " + to_text(loaded.b_m) +
                    " m, and has to be the distance between the wheels in metres, such as 0.29",
                EndPoseProblem::bad_wheelbase, {to_text(loaded.b_m)});
  }
  if (!usable(loaded.c_r) || !usable(loaded.c_l)) {
    throw Error("the loaded wheel factors are c_R = " + to_text(loaded.c_r) + " and c_L = " +
                    to_text(loaded.c_l) + ", and have to be positive ratios, 1 for a nominal wheel",
                EndPoseProblem::bad_wheel_factors, {to_text(loaded.c_r), to_text(loaded.c_l)});
  }
}

}  // namespace astro::calibration
