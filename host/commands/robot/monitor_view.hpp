#pragma once

#include <optional>
#include <string>

#include "common/protocol/telemetry.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/robot/client/client.hpp"

/// What `monitor` shows.
namespace astro::commands {

/// State of the link to the robot.
struct LinkFigures {
  double round_trip_ms = 0;
  std::optional<double> drift;  // of the robot's clock, device seconds per host second minus 1
  robot::LinkCounts counts;
  protocol::FrameCounts frames;
  std::string lost;  // "" or why the link is lost at the moment
};

/// A picture for a terminal of 80 columns and 24 rows: lines, each ended by a newline.
std::string monitor_picture(const std::string& robot, const protocol::Telemetry& telemetry,
                            const LinkFigures& link);

/// The same in one line, for terminals that cannot redraw: mode, faults, battery, pose.
std::string monitor_line(const protocol::Telemetry& telemetry, const LinkFigures& link);

/// The same sample for programs.
Json to_json(const protocol::Telemetry& telemetry);

}  // namespace astro::commands
