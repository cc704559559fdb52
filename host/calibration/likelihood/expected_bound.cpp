#include "host/calibration/likelihood/expected_bound.hpp"

#include <algorithm>

#include "host/calibration/likelihood/innovation.hpp"
#include "host/calibration/likelihood/moves.hpp"
#include "host/calibration/likelihood/sample_selection.hpp"

namespace astro::calibration {
namespace {

FixedParameters fixed_of(std::span<const PreparedRun> runs, bool with_e, bool clock_known) {
  FixedParameters fixed;
  fixed.clock = clock_known;
  fixed.e = !with_e;
  fixed.lever_yaw =
      std::none_of(runs.begin(), runs.end(), [](const PreparedRun& run) { return run.has_headings; });
  return fixed;
}

}  // namespace

ExpectedBound::ExpectedBound(std::span<const PreparedRun> runs, const WheelFactors& factors,
                             const LeverArm& lever, const NoiseModel& noise, bool clock_known,
                             double spacing_m)
    : factors_(factors),
      lever_(lever),
      noise_(noise),
      spacing_m_(spacing_m),
      fixed_(fixed_of(runs, factors.e != 0, clock_known)),
      pool_(fixed_) {}

void ExpectedBound::add(const PreparedRun& run, const ClockFit& clock) {
  Unknowns u = Unknowns::Zero();
  u.head<kShared>() << factors_.c_r, factors_.c_l, factors_.b_m, factors_.e, lever_.x_m, lever_.y_m,
      lever_.yaw_rad, clock.skew;
  u[kClockOffset] = clock.offset_s;
  InnovationSums sums;
  sums.session = run.session;
  const SampleSelection samples = selection_of(run.path_m, spacing_m_);
  sums.information = expected_information(Moves(run, u, kUsualKappa0, {samples}), noise_, samples);
  pool_.add(reduced(sums, fixed_, 0));
}

}  // namespace astro::calibration
