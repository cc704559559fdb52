#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "host/live/driver/robot_link.hpp"

namespace astro::page {

/// The robot's parameters as one page shows and changes them: its values are staged here until a commit puts them in force together,
/// in the robot's flash, by the rules of every other program (host/robot/parameters).
class ParameterCalls {
 public:
  using Answer = nlohmann::json;

  /// The table as it was read last, with what is staged.
  Answer list(live::RobotSession& session) const;

  /// Throws astro::Error for a name that the robot does not have and a value that its table does not allow.
  Answer stage(live::RobotSession& session, const nlohmann::json& question);
  /// Puts what is staged in force and reads it back. Throws RobotCallProblem::needs_confirmation for changes that a person has to
  /// confirm, unless the question has "confirm": true; what robot::commit_at_rest throws.
  Answer commit(live::RobotSession& session, const nlohmann::json& question);
  Answer discard();

 private:
  Answer staged() const;

  std::map<std::string, robot::Value> staged_;
};

}  // namespace astro::page
