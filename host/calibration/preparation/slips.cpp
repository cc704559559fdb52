#include "host/calibration/preparation/slips.hpp"

#include <algorithm>
#include <cmath>

namespace astro::calibration {
namespace {

// What is not known after a slip. Who kicks a robot also moves it; and what measured the turn has an error, and so has its beginning.
constexpr double kMoved_m = 0.5, kTurned_rad = 0.02, kOfTurn = 0.1;

}  // namespace

std::shared_ptr<const Trajectory> turned_by_slips(const Trajectory& run, const WheelFactors& loaded) {
  if (run.slips.empty()) return nullptr;
  const auto turned = std::make_shared<Trajectory>(run);
  for (WheelSample& sample : turned->wheels) {
    double turn_rad = 0;
    for (const Slip& slip : run.slips)
      turn_rad += slip.end_s > slip.begin_s
                      ? slip.turn_rad *
                            std::clamp((sample.time_s - slip.begin_s) / (slip.end_s - slip.begin_s), 0.0, 1.0)
                      : (sample.time_s > slip.begin_s ? slip.turn_rad : 0);
    sample.right_m += turn_rad * loaded.b_m / 2 / loaded.c_r;
    sample.left_m -= turn_rad * loaded.b_m / 2 / loaded.c_l;
  }
  return turned;
}

std::vector<WheelGap> gaps_of_slips(const Trajectory& run) {
  std::vector<WheelGap> gaps;
  for (const Slip& slip : run.slips) {
    const double turned_rad = kTurned_rad + kOfTurn * std::abs(slip.turn_rad);
    gaps.push_back({slip.begin_s, slip.end_s, kMoved_m * kMoved_m, turned_rad * turned_rad});
  }
  return gaps;
}

std::vector<WheelGap> joined(std::vector<WheelGap> gaps, const std::vector<WheelGap>& more) {
  gaps.insert(gaps.end(), more.begin(), more.end());
  std::ranges::sort(gaps, {}, &WheelGap::begin_s);
  std::vector<WheelGap> apart;
  for (const WheelGap& gap : gaps) {
    if (apart.empty() || gap.begin_s >= apart.back().end_s) {
      apart.push_back(gap);
      continue;
    }
    apart.back().end_s = std::max(apart.back().end_s, gap.end_s);
    apart.back().unknown_m2 += gap.unknown_m2;
    apart.back().unknown_rad2 += gap.unknown_rad2;
  }
  return apart;
}

}  // namespace astro::calibration
