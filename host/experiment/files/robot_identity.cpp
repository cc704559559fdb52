#include "host/experiment/files/robot_identity.hpp"

#include <fmt/format.h>

#include "host/base/text/plain_text.hpp"

namespace astro::experiment {
namespace {

std::string text_of(const RobotIdentity& robot) {
  return robot.name.empty() ? robot.id : fmt::format("{} ({})", robot.name, robot.id);
}

}  // namespace

RobotIdentity identity_of(const protocol::HelloReply& robot) {
  RobotIdentity identity;
  identity.name = plain_text(robot.robot_name.view());
  for (const std::uint8_t byte : robot.unique_id) identity.id += fmt::format("{:02x}", byte);
  return identity;
}

RobotIdentity identity_of(const recording::RunInfo& info) { return {info.robot_name, info.robot_id}; }

std::string different_robots(const std::string& what, const RobotIdentity& a, const std::string& other,
                             const RobotIdentity& b) {
  if (a.id.empty() || b.id.empty() || a.id == b.id) return {};
  return fmt::format("{} is of robot {}, and {} is {}", what, text_of(a), other, text_of(b));
}

}  // namespace astro::experiment
