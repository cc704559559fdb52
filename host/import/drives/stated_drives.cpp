#include "host/import/drives/stated_drives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/base/text/numbers.hpp"
#include "host/import/drives/unused_choice.hpp"
#include "host/import/wheels/travel_measure.hpp"

namespace astro::importing {
namespace {

/// Each side's wheels, of which a robot may have several: "front_left+rear_left", "front_right+rear_right".
std::vector<JointPair> joints_in(const std::vector<std::string>& sides) {
  if (sides.empty()) return {};
  const auto wheels_in = [](std::string_view side) {
    std::vector<std::string> wheels;
    for (std::size_t end = 0; end != std::string_view::npos;
         side.remove_prefix(std::min(end + 1, side.size())))
      wheels.emplace_back(side.substr(0, end = side.find('+')));
    return wheels;
  };
  const Error unpaired("each wheel on the left needs one on the right: name as many joints of both sides",
                       StatementProblem::joints_not_paired);
  if (sides.size() != 2) throw Error(unpaired);
  const std::vector<std::string> left = wheels_in(sides[0]), right = wheels_in(sides[1]);
  if (left.size() != right.size()) throw Error(unpaired);
  std::vector<JointPair> pairs;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i].empty() || right[i].empty()) throw Error(unpaired);
    pairs.push_back({left[i], right[i]});
  }
  return pairs;
}

/// Written so that a NaN is refused, too.
std::optional<double> within(const Limits& limits, const char* name, std::optional<double> size) {
  if (size && !(*size >= limits.least && *size <= limits.most))
    throw Error(fmt::format("{} is {}, and must be from {} to {}", name, *size, limits.least, limits.most),
                StatementProblem::size_beyond_limits,
                {name, fmt::to_string(*size), fmt::to_string(limits.least), fmt::to_string(limits.most)});
  return size;
}

RobotGeometry geometry_of(const StatedDrives& drives) {
  RobotGeometry geometry;
  if (!drives.robot_file.empty()) geometry = read_robot_file(drives.robot_file, drives.controller);
  RobotGeometry given;
  given.wheel_diameter_m = within(kWheelDiameterLimits_m, "wheel_diameter", drives.wheel_diameter_m);
  given.counts_per_turn = within(kCountsPerTurnLimits, "counts_per_turn", drives.counts_per_turn);
  given.wheelbase_m = within(kWheelbaseLimits_m, "wheelbase", drives.wheelbase_m);
  if (const auto joints = joints_in(drives.joints); !joints.empty()) given.joints = joints.front();
  return geometry.overridden_by(given);
}

std::optional<truth::Direction3> axis_in(const std::string& word) {
  if (word.empty()) return std::nullopt;
  if (const auto axis = axis_named(word)) return axis;
  throw Error(
      "'" + word + "' is no axis: name x, y or z, one with a minus before it, or three numbers as 0,1,0",
      StatementProblem::unknown_axis, {word});
}

/// Of length one.
std::optional<truth::Direction3> imu_axis_of(const StatedDrives& drives) {
  std::optional<truth::Direction3> axis = axis_in(drives.imu_axis);
  if (!axis) return axis;
  const double length = std::hypot((*axis)[0], (*axis)[1], (*axis)[2]);
  for (double& part : *axis) part /= length;
  return axis;
}

std::optional<TravelMeasure> measure_of(const StatedDrives& drives) {
  const auto measure = travel_measure(drives.wheels_unit);
  if (!measure && !drives.wheels_unit.empty())
    throw Error("'" + drives.wheels_unit + "' is no unit of a wheel's travel or speed",
                StatementProblem::unknown_unit, {drives.wheels_unit});
  return measure;
}

}  // namespace

std::optional<truth::Direction3> axis_named(std::string_view text) {
  const bool negative = text.starts_with('-') && text.size() == 2;
  const std::string_view name = negative ? text.substr(1) : text;
  if (name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') {
    truth::Direction3 axis{0, 0, 0};
    axis[static_cast<std::size_t>(name[0] - 'x')] = negative ? -1 : 1;
    return axis;
  }
  truth::Direction3 axis{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t comma = text.find(',');
    if ((i < 2) == (comma == std::string_view::npos)) return std::nullopt;
    const auto value = typed_number(text.substr(0, comma));
    if (!value) return std::nullopt;
    axis[i] = *value;
    text.remove_prefix(i < 2 ? comma + 1 : text.size());
  }
  if (std::hypot(axis[0], axis[1], axis[2]) == 0) return std::nullopt;
  return axis;
}

ImportChoices choices_of(const StatedDrives& drives) {
  if (!drives.frames.empty() && drives.frames.size() != 2)
    throw Error("a transform has two frames: name the parent and the child",
                StatementProblem::frames_not_two);
  ImportChoices choices;
  choices.geometry = geometry_of(drives);
  choices.wheels.table = drives.table;
  choices.wheels.table.counter_range = choices.wheels.bag.counter_range =
      within(kCounterRangeLimits, "counter_range", drives.table.counter_range);
  choices.wheels.bag.topic = drives.wheels_topic;
  choices.wheels.bag.joints = choices.geometry.joints;
  if (const auto joints = joints_in(drives.joints); !joints.empty())
    choices.wheels.bag.further.assign(joints.begin() + 1, joints.end());
  choices.wheels.bag.measure = measure_of(drives);
  if (choices.geometry.wheelbase_m) choices.wheels.bag.odometry = choices.geometry.factors();
  choices.wheels.imu_topic = drives.imu_topic;
  choices.wheels.imu_axis = imu_axis_of(drives);
  choices.wheels.exchanged = drives.swap_wheels;
  choices.wheels.reversed = drives.reverse_wheels;
  choices.drives_backward = drives.drives_backward;
  choices.truth.body = drives.body;
  choices.truth.columns = drives.truth_columns;
  choices.truth.poses.topic = drives.truth_topic;
  if (!drives.frames.empty()) {
    choices.truth.poses.frame = drives.frames[0];
    choices.truth.poses.child_frame = drives.frames[1];
  }
  choices.floor.up = axis_in(drives.up);
  choices.truth.length_unit = drives.unit;
  if (drives.mirrored != "auto") choices.floor.mirrored = drives.mirrored == "yes";
  return choices;
}

std::vector<DriveFiles> drive_files(const StatedDrives& drives) {
  if (drives.wheels.size() != drives.truth.size())
    throw Error(fmt::format("there are {} files of wheels and {} of ground truth: each drive needs both",
                            drives.wheels.size(), drives.truth.size()),
                StatementProblem::not_paired,
                {std::to_string(drives.wheels.size()), std::to_string(drives.truth.size())});
  std::vector<DriveFiles> files;
  for (std::size_t i = 0; i < drives.wheels.size(); ++i) files.push_back({drives.wheels[i], drives.truth[i]});
  return files;
}

ImportedDrives import_stated(const StatedDrives& drives) {
  const std::vector<DriveFiles> files = drive_files(drives);
  refuse_unused_choices(drives);
  return import_drives(files, choices_of(drives));
}

}  // namespace astro::importing
