#pragma once

#include <cstddef>
#include <optional>

#include "host/calibration/motion/clock_search.hpp"
#include "host/calibration/motion/clock_step.hpp"
#include "host/calibration/motion/trajectory.hpp"

/// Where a stream's own stamps show that its clock was set on, and how that is taken back.
namespace astro::calibration {

enum class StampedStream { odometry, ground_truth };

/// A leap between two of a stream's samples.
struct StampLeap {
  StampedStream stream = StampedStream::odometry;
  std::size_t after = 0;  // the first sample after it
  double by_s = 0;        // by which the samples from there on are stamped late
};

/// The leap that is as long as a step that the motion shows.
std::optional<StampLeap> find_leap(const Trajectory& run, const ClockStep& step, const ClockFit& clock);

/// The longest leap of at least 0.06 s over which the robot went on at one speed, but hardly got on. Where samples are lost, it
/// does get on, by its counts and by its poses. So a step shows in a steady motion, which no offset shows.
std::optional<StampLeap> find_leap_without_way(const Trajectory& run, double wheelbase_m);

/// Sets what follows the leap back, so that the stream has one clock.
void take_back(Trajectory& run, const StampLeap& leap);

}  // namespace astro::calibration
