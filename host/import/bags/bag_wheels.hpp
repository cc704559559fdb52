#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/import/wheels/joint_names.hpp"
#include "host/import/wheels/travel_measure.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// What a person states about wheels in bags; what is not given is recognised.
struct BagWheelSelection {
  std::string topic;      // or topics and fields, as for named_source (wheel_sources.hpp)
  JointPair joints = {};  // of messages of joints
  /// Further wheels on the same sides: a side's travel is the mean of its wheels.
  std::vector<JointPair> further = {};
  std::optional<TravelMeasure> measure = {};  // of fields whose names do not show it, or show it wrongly
  /// How many different counts a counter has before it starts again; nothing: found from the data.
  std::optional<double> counter_range = {};
  /// With which the robot computes its odometry; without them odometry is not turned back into wheels.
  std::optional<calibration::WheelFactors> odometry = {};
};

/// The wheels in a bag, from whatever its messages say of them: joints (joint_wheels.hpp), numbers in
/// messages of any type (field_wheels.hpp), or the robot's own odometry (odometry_wheels.hpp). If no topic is
/// given, joints are taken; if there are none whose names are recognised, other counters; and odometry only
/// if there is nothing else. Remarks say what was inferred.
///
/// Errors  UnclearChoice (unclear_choice.hpp) if a topic, joints, fields or a unit are neither given nor
///         recognised, or not in the bag; astro::Error of odometry_needs_sizes; what the readers above throw.
WheelTrack wheels_in_bag(const std::filesystem::path& path, const BagWheelSelection& selection = {});

}  // namespace astro::importing
