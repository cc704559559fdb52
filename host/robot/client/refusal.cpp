#include "host/robot/client/refusal.hpp"

#include "common/protocol/messages.hpp"
#include "common/safety/fault.hpp"
#include "host/robot/client/robot_problem.hpp"

namespace astro::robot {

namespace {

std::string addition(protocol::ErrorCode code, std::uint16_t detail) {
  switch (code) {
    case protocol::ErrorCode::faulted:
      return ": " + std::string(name(static_cast<Fault>(detail)));
    case protocol::ErrorCode::invalid_parameter:
    case protocol::ErrorCode::unknown_parameter:
      return detail == 0 ? "" : ": parameter " + std::to_string(detail);
    case protocol::ErrorCode::wrong_version:
      return ": the robot speaks protocol " + std::to_string(detail);
    default:
      return detail == 0 ? "" : " (detail " + std::to_string(detail) + ")";
  }
}

/// The clause of protocol::meaning without its explanation of the detail, which is for programs; for what happens to people
/// every day, what to do.
std::string clause(protocol::ErrorCode code) {
  if (code == protocol::ErrorCode::not_armed)
    return "arm it first: nobody has, or somebody has stopped or paused it since";
  const std::string_view all = protocol::meaning(code);
  return std::string(all.substr(0, all.find("; detail")));
}

std::string sentence(std::string_view what, protocol::ErrorCode code, std::uint16_t detail,
                     std::string_view why) {
  return "the robot refused " + std::string(what) + ": " +
         (why.empty() ? clause(code) + addition(code, detail) : std::string(why));
}

Remark remark_on(std::string_view what, protocol::ErrorCode code, std::uint16_t detail, std::string_view why,
                 const std::vector<std::string>& values) {
  Remark remark{sentence(what, code, detail, why), RobotProblem::refused, values};
  if (values.empty()) remark.values = {std::string(what)};
  if (code != protocol::ErrorCode::faulted || !why.empty()) return remark;
  return {remark.sentence, RobotProblem::faulted, {std::string(name(static_cast<Fault>(detail)))}};
}

}  // namespace

RobotRefused::RobotRefused(std::string_view what, protocol::ErrorCode code, std::uint16_t detail,
                           std::string_view why, const std::vector<std::string>& values)
    : Error(remark_on(what, code, detail, why, values)), code_(code), detail_(detail) {}

std::string fault_names(std::uint32_t mask) {
  std::string names;
  for (unsigned i = 0; i < 32; ++i) {
    if (((mask >> i) & 1U) == 0) continue;
    const auto fault = static_cast<Fault>(i);
    names += (names.empty() ? "" : ", ") +
             (name(fault) == "?" ? "fault " + std::to_string(i) : std::string(name(fault)));
  }
  return names;
}

}  // namespace astro::robot
