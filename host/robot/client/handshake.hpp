#pragma once

#include <cstdint>
#include <string>

#include "common/protocol/messages.hpp"
#include "host/base/error.hpp"

/// Checks what answers at a port: whether it is a robot, which protocol version it speaks, and whether it is
/// the same robot as before.
namespace astro::robot {

/// Why this program cannot talk to a robot at a port. Values: the port; then for program_outdated and
/// firmware_outdated the robot's protocol version and this program's, and for other_robot its name and the
/// name of the robot that was there before.
enum class HandshakeProblem {
  nothing_comes,
  no_frames,
  looped_back,
  robot_does_not_hear,
  program_outdated,
  firmware_outdated,
  other_robot
};

/// What came back from a port at which no robot answered.
struct NoAnswer {
  Remark why_silent;  // the transport's reason; empty if it knows none
  bool echo = false;  // the line sends back what we send
  std::uint64_t bytes = 0, good_frames = 0;
};

/// The most likely reason, as a sentence about the port `name`.
Error no_robot(const std::string& name, const NoAnswer& came);

/// Throws Error if the robot speaks another protocol version than this program.
void require_version(const std::string& name, std::uint16_t theirs);

/// Throws Error if the robot that answers is not the known one (unique_id).
void require_same_robot(const std::string& name, const protocol::HelloReply& known,
                        const protocol::HelloReply& answers);

/// "1.4.0"
std::string firmware_version(const protocol::HelloReply& robot);

}  // namespace astro::robot
