#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "host/motor/bench/tune_motors.hpp"
#include "host/motor/model/wiring.hpp"
#include "host/page/calls/calls.hpp"
#include "host/page/robot/opened_robot.hpp"
#include "host/robot/motion/drive.hpp"

namespace astro::page {

/// What is measured on a robot that was just built, by the rules of host/motor and host/experiment. Each call that drives returns when
/// the robot is at rest and disarmed; what was measured before is kept from call to call. README.md beside this file has questions
/// and answers.
///
/// Errors  astro::Error for a call that comes too early; what the library throws, Interrupted among it.
class Measurements {
 public:
  using Answer = nlohmann::json;

  /// A robot that nobody drives.
  struct Task {
    OpenedRobot& robot;
    live::RobotSession& session;
    robot::DriveHooks drive;
    Emit tell;  // the page that asks
    std::filesystem::path folder;
  };

  Answer probe_motor(const Task& task, const nlohmann::json& question);
  Answer tune(const Task& task, const nlohmann::json& question);
  Answer load_tuning(const Task& task, const nlohmann::json& question);
  Answer experiment(const Task& task, const nlohmann::json& question);
  Answer push(const Task& task, const nlohmann::json& question);

  /// These drive nothing.
  Answer judge_wiring(live::RobotSession& session, const nlohmann::json& question) const;
  /// `now`: telemetry of this moment, with counts.
  Answer roll(live::RobotSession& session, const protocol::Telemetry& now, const nlohmann::json& question);

 private:
  std::array<std::optional<motor::Probe>, 2> probes_;     // by motor
  std::optional<std::array<std::int32_t, 2>> roll_from_;  // counts
  std::optional<motor::TuningResult> tuning_;
};

}  // namespace astro::page
