#pragma once

#include <span>
#include <vector>

#include "host/calibration/motion/clock_search.hpp"
#include "host/calibration/motion/wheel_path.hpp"
#include "host/calibration/preparation/prepared_run.hpp"

namespace astro::calibration {

/// The wheels at each sample of truth.
std::vector<WheelState> wheels_at_truth(const PreparedRun& run, const ClockFit& clock);

/// The way of the wheels from the first sample of truth to each, in metres: the mean of both wheels, which grows in a spin as
/// well. `wheels`: those of wheels_at_truth.
std::vector<double> way_of_wheels(std::span<const WheelState> wheels);

/// The way by which samples are chosen (SampleSelection): that of the wheels, but held where tyres are being wound up.
///
/// In a spin the tyres and a castor wind up, and let go of it within hardly any travel once the robot drives on: a sample in
/// between lags behind the wheels. A spin with the stands around it offers its middle only, for knots in its first half, and
/// its end is offered where the robot has driven on. So what was wound up and what is let go of fall between the same two
/// samples as often as not, and on both sides of the middle alike. Of a spin that lasts, the first and the last half
/// wheelbase count so.
///
/// `run`: with its motion and path_m. `wheelbase_m`: roughly right.
std::vector<double> way_of_knots(const PreparedRun& run, double wheelbase_m);

}  // namespace astro::calibration
