#pragma once

#include "host/formats/messages/std.hpp"

namespace astro::ros2::msg {

/// Our own: what an Astrolabe robot measures and commands in one control tick, for plots. SI units; forward, left and
/// counter-clockwise are positive.
struct Telemetry {
  Header header;
  std::string mode, faults;
  double left_speed = 0, right_speed = 0;          // of the wheels' rims, observed
  double left_setpoint = 0, right_setpoint = 0;    // commanded
  double left_duty = 0, right_duty = 0;            // fraction of the supply
  double linear_speed = 0, yaw_rate = 0;           // of the base, observed
  std::int32_t left_counts = 0, right_counts = 0;  // wrap at 2^32
  double battery_voltage = 0;
  std::uint16_t segment = 0, queued_segments = 0;  // of a path; 0: none runs
  double segment_progress = 0, cross_track_error = 0, heading_error = 0;
  double x_deviation = 0, y_deviation = 0, yaw_deviation = 0;  // standard deviations of odometry

  static constexpr std::string_view kType = "astrolabe_msgs/msg/Telemetry";
  static constexpr std::tuple kFields{Field{&Telemetry::header, "header"},
                                      Field{&Telemetry::mode, "mode"},
                                      Field{&Telemetry::faults, "faults"},
                                      Field{&Telemetry::left_speed, "left_speed"},
                                      Field{&Telemetry::right_speed, "right_speed"},
                                      Field{&Telemetry::left_setpoint, "left_setpoint"},
                                      Field{&Telemetry::right_setpoint, "right_setpoint"},
                                      Field{&Telemetry::left_duty, "left_duty"},
                                      Field{&Telemetry::right_duty, "right_duty"},
                                      Field{&Telemetry::linear_speed, "linear_speed"},
                                      Field{&Telemetry::yaw_rate, "yaw_rate"},
                                      Field{&Telemetry::left_counts, "left_counts"},
                                      Field{&Telemetry::right_counts, "right_counts"},
                                      Field{&Telemetry::battery_voltage, "battery_voltage"},
                                      Field{&Telemetry::segment, "segment"},
                                      Field{&Telemetry::queued_segments, "queued_segments"},
                                      Field{&Telemetry::segment_progress, "segment_progress"},
                                      Field{&Telemetry::cross_track_error, "cross_track_error"},
                                      Field{&Telemetry::heading_error, "heading_error"},
                                      Field{&Telemetry::x_deviation, "x_deviation"},
                                      Field{&Telemetry::y_deviation, "y_deviation"},
                                      Field{&Telemetry::yaw_deviation, "yaw_deviation"}};
  bool operator==(const Telemetry&) const = default;
};

}  // namespace astro::ros2::msg
