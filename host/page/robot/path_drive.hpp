#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/live/driver/robot_link.hpp"
#include "host/robot/motion/paths.hpp"

namespace astro::page {

/// A path that an armed robot drives while its caller does other things: step() fills the robot's queue and finds its end.
class PathDrive {
 public:
  static constexpr const char* kFinished = "finished";

  /// The session must outlive it.
  PathDrive(live::RobotSession& session, robot::Path path);

  /// Sends what the robot has room for. Throws what a request throws, but for a refusal, which ends the path.
  void step();

  std::size_t segments() const { return path_.size(); }
  /// The part of the path that was driven, by its segments. `newest`: the robot's telemetry with its path.
  double done(const protocol::Telemetry& newest) const;
  /// kFinished, or why it ended early; none while it goes on.
  const std::optional<std::string>& ended() const { return ended_; }

 private:
  void fill();
  void ask();
  void end_at_rest();

  live::RobotSession& session_;
  robot::Path path_;
  std::size_t accepted_ = 0, done_ = 0;
  microseconds heard_at_{};  // when it came further
  std::optional<std::string> ended_;
  robot::Subscription on_done_;
};

}  // namespace astro::page
