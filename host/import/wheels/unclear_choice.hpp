#pragma once

#include <string>
#include <vector>

#include "host/base/error.hpp"

namespace astro::importing {

/// What cannot be decided from a file alone. Values: what there is to choose from; of odometry_needs_sizes
/// its topic.
enum class WheelProblem {
  columns_unclear,
  joints_unclear,
  topic_unclear,
  fields_unclear,
  unit_unclear,
  odometry_needs_sizes,
  poses_unclear,
  controller_unclear,
  imu_unclear,
  nothing_to_choose
};

/// What a remark reports about a choice. Values: the joints of the left and of the right wheel; the stream of
/// poses and its type; the name of the source of the wheels (wheel_sources.hpp) and its unit; the topic of
/// the odometry; the topics of the IMUs; an axis with its sign and the topic of its IMU; that topic.
enum class ChoiceRemark {
  joints_recognised,
  poses_recognised,
  poses_may_be_estimate,
  wheels_recognised,
  wheels_from_odometry,
  several_imus,
  yaw_axis_recognised,
  yaw_axis_unclear
};

/// Thrown if a file alone does not show what was meant, or does not contain it; values() lists what there is
/// to choose from.
class UnclearChoice : public Error {
 public:
  UnclearChoice(const std::string& sentence, const std::vector<std::string>& choices, WheelProblem unclear)
      : Error(choices.empty() ? sentence + ": name the right file" : sentence,
              choices.empty() ? WheelProblem::nothing_to_choose : unclear, choices) {}
};

/// The choices separated by commas; "none" if there are none.
inline std::string listed(const std::vector<std::string>& choices) {
  std::string text;
  for (const std::string& choice : choices) text += (text.empty() ? "" : ", ") + choice;
  return text.empty() ? "none" : text;
}

}  // namespace astro::importing
