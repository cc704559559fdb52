#pragma once

#include "host/base/bytes.hpp"
#include "host/formats/messages/robot_model.hpp"
#include "host/recording/run.hpp"

namespace astro::recording {

/// The messages with which viewers (RViz, Foxglove's 3D panel) show the robot of a run without configuration: its description,
/// the poses of its base and wheels, and how far the wheels have turned. The sizes come from the parameters of the run; without
/// them there is no description, and only the base moves.
class RobotMessages {
 public:
  explicit RobotMessages(const RunInfo& info) : model_(info.parameters) {}

  bool knows_sizes() const { return model_.complete(); }

  /// URDF as a std_msgs/msg/String. Precondition: knows_sizes().
  Bytes description() const;

  /// Takes the next sample. Counts may wrap at 2^32.
  void advance(const OdometrySample& sample);
  /// A tf2_msgs/msg/TFMessage: odom -> base_link, and base_link -> each wheel.
  Bytes transforms() const;
  /// A sensor_msgs/msg/JointState of both wheels. Precondition: knows_sizes().
  Bytes joints() const;

 private:
  ros2::RobotModel model_;
  OdometrySample sample_;
  bool any_ = false;
  std::int64_t left_counts_ = 0, right_counts_ = 0;  // since the first sample
};

}  // namespace astro::recording
