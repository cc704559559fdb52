#pragma once

#include <span>
#include <vector>

#include "host/calibration/motion/clock_search.hpp"
#include "host/calibration/motion/wheel_path.hpp"
#include "host/calibration/preparation/prepared_run.hpp"

namespace astro::calibration {

/// The wheels at each sample of truth.
std::vector<WheelState> wheels_at_truth(const PreparedRun& run, const ClockFit& clock);

/// The path length of the wheels from the first sample of truth to each, in metres. It is the mean of both wheels, so it grows
/// in a spin as well. `wheels`: the result of wheels_at_truth.
std::vector<double> way_of_wheels(std::span<const WheelState> wheels);

/// The path length by which samples are chosen (SampleSelection): that of the wheels, but held constant where tyres wind up.
///
/// In a spin the tyres and a castor wind up, and they unwind within hardly any travel once the robot drives on. A sample in
/// between lags behind the wheels. So a spin, together with the rests next to it, offers only the sample in its middle for
/// knots in its first half. Its end is offered only after the robot has driven on. Then wind-up and unwinding fall between the
/// same two samples as often as not, and equally on both sides of the middle. In a long spin this holds for the first and the
/// last half wheelbase of path.
///
/// `run`: with its motion and path_m. `wheelbase_m`: roughly right.
std::vector<double> way_of_knots(const PreparedRun& run, double wheelbase_m);

}  // namespace astro::calibration
