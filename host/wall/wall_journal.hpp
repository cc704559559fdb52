#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "host/experiment/files/robot_identity.hpp"
#include "host/wall/drive_against_wall.hpp"
#include "host/wall/wall_plan.hpp"
#include "host/wall/wall_robot.hpp"

namespace astro::wall {

/// The settings of a calibration against a wall.
struct WallPlan {
  WallTargets targets;
  double line_m = 3;  // of the laps
  int readings = 2;   // of the ruler
  double gap_m = 2;   // which it shows
  double speed_mps = 0.7, yaw_rate_radps = 1.8;
  double most_minutes = 10;  // of driving
  double squaring_rad =
      WallNoise{}.squaring_rad;  // as exactly the front lies against the wall each time, roughly
  PushLimit push;
  BodySize body;

  /// What is known of the noise beforehand.
  WallNoise usual_noise() const;

  /// Throws astro::Error naming the value that cannot be driven.
  void check() const;
};

/// wall.json: what was driven so far, so that the calibration can be resumed. All counts are in travel of a
/// nominal wheel.
struct WallJournal {
  WallPlan plan;
  experiment::RobotIdentity robot;
  std::string started_at;
  double count_m = 0;                // the nominal wheel to which the travels refer
  calibration::WheelFactors loaded;  // when it began
  WallDrive drive;
  std::vector<WallMove> moves;  // that were driven and kept
  double driven_s = 0;
};

std::optional<WallJournal> read_wall_journal(const std::filesystem::path& folder);
void write_wall_journal(const std::filesystem::path& folder, const WallJournal& journal);

/// Reads the journal in `folder`, or writes a new one.
///
/// Throws astro::Error if the folder holds another plan, another robot's drive, one of another wheel, or a damaged file.
WallJournal open_wall_journal(const std::filesystem::path& folder, const WallPlan& plan,
                              const experiment::RobotIdentity& robot, const WallRobot& facts);

}  // namespace astro::wall
