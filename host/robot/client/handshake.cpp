#include "host/robot/client/handshake.hpp"

namespace astro::robot {

Error no_robot(const std::string& name, const NoAnswer& came) {
  if (!came.why_silent.sentence.empty()) return Error(came.why_silent.in(name + " does not answer: "));
  if (came.echo)
    return Error(name + " sends back what it is sent: it is a looped-back line or a terminal, not a robot",
                 HandshakeProblem::looped_back, {name});
  if (came.bytes == 0)
    return Error(
        name + " does not answer: is it a robot running Astrolabe, switched on and set to this baud rate?",
        HandshakeProblem::nothing_comes, {name});
  if (came.good_frames == 0)
    return Error(
        name +
            " is not an Astrolabe robot: it sends bytes that are no Astrolabe frames (another device, or "
            "another baud rate)",
        HandshakeProblem::no_frames, {name});
  return Error(name + " sends Astrolabe frames but does not answer: is the line to the robot connected?",
               HandshakeProblem::robot_does_not_hear, {name});
}

void require_version(const std::string& name, std::uint16_t theirs) {
  constexpr std::uint16_t kOurs = protocol::kProtocolVersion;
  if (theirs == kOurs) return;
  const bool newer = theirs > kOurs;
  throw Error("the robot at " + name + " speaks protocol " + std::to_string(theirs) +
                  ", this program speaks " + std::to_string(kOurs) +
                  (newer ? ": update this program" : ": update the robot's firmware"),
              newer ? HandshakeProblem::program_outdated : HandshakeProblem::firmware_outdated,
              {name, std::to_string(theirs), std::to_string(kOurs)});
}

void require_same_robot(const std::string& name, const protocol::HelloReply& known,
                        const protocol::HelloReply& answers) {
  if (answers.unique_id == known.unique_id) return;
  const std::string now(answers.robot_name.view()), before(known.robot_name.view());
  throw Error("another robot, '" + now + "', answers at " + name + " where '" + before +
                  "' was before: connect the first one again",
              HandshakeProblem::other_robot, {name, now, before});
}

std::string firmware_version(const protocol::HelloReply& robot) {
  return std::to_string(robot.fw_major) + '.' + std::to_string(robot.fw_minor) + '.' +
         std::to_string(robot.fw_patch);
}

}  // namespace astro::robot
