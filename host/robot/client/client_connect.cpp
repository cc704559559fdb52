#include <algorithm>

#include "host/robot/client/client.hpp"
#include "host/robot/client/restore.hpp"

/// Handshake and reconnection: which robot answers, and is it the same as before.
namespace astro::robot {

const protocol::HelloReply& Client::connect(RetryPolicy policy) {
  forget();
  counts_ = {};
  echo_ = false;
  receiver_.drain(transport_);
  constexpr std::uint8_t kEndOfWhateverCameBefore = 0;
  transport_.write({&kEndOfWhateverCameBefore, 1});

  const std::uint16_t id = next_id();
  const Restore connecting(connecting_, true);
  const auto body = ask(protocol::Frame(protocol::Hello{}, id).bytes(), id, policy);
  if (!body) no_robot();
  if (body->front() == protocol::ErrorReply::kId) {
    const auto error = understand<protocol::ErrorReply>(*body, "Hello");
    if (error.code == protocol::ErrorCode::wrong_version) check_version(error.detail);
    throw RobotRefused("Hello", error.code, error.detail);
  }
  robot_ = understand<protocol::HelloReply>(*body, "Hello");
  check_version(robot_.protocol_version);
  return robot_;
}

void Client::reconnect(microseconds timeout) {
  const protocol::HelloReply known = robot_;
  const microseconds deadline = now() + timeout;
  // A failed try usually takes time. In virtual time a transport may fail without letting time pass; the
  // number of tries ends that case.
  for (auto tries = timeout / std::chrono::milliseconds(10); true; --tries) {
    try {
      transport_.reopen(std::max(deadline - now(), microseconds::zero()));
      connect();
      break;
    } catch (const Error& error) {
      if (now() >= deadline || tries <= 0)
        throw LinkLost(std::string("the link did not come back: ") + error.what());
    }
  }
  if (robot_.unique_id == known.unique_id) return;
  const std::string other(robot_.robot_name.view());
  robot_ = known;
  throw Error("another robot, '" + other + "', answers at " + name() + " where '" +
              std::string(known.robot_name.view()) + "' was before: connect the first one again");
}

void Client::no_robot() {
  if (const std::string why = transport_.why_silent(); !why.empty())
    throw Error(name() + " does not answer: " + why);
  if (echo_) {
    throw Error(name() + " sends back what it is sent: it is a looped-back line or a terminal, not a robot");
  }
  if (receiver_.bytes() == 0) {
    throw Error(name() +
                " does not answer: is it a robot running Astrolabe, switched on and set to this baud rate?");
  }
  if (receiver_.frames().good == 0) {
    throw Error(name() +
                " is not an Astrolabe robot: it sends bytes that are no Astrolabe frames (another device, or "
                "another baud rate)");
  }
  throw Error(name() + " sends Astrolabe frames but does not answer: is the line to the robot connected?");
}

void Client::check_version(std::uint16_t theirs) const {
  constexpr std::uint16_t kOurs = protocol::kProtocolVersion;
  if (theirs == kOurs) return;
  throw Error("the robot at " + name() + " speaks protocol " + std::to_string(theirs) +
              ", this program speaks " + std::to_string(kOurs) + ": update " +
              (theirs > kOurs ? "this program" : "the robot's firmware"));
}

void Client::not_understood(std::string_view request) const {
  throw Error(
      "the answer of " + name() + " to " + std::string(request) +
      " cannot be understood although its check sum is right: firmware and this program differ, update both");
}

}  // namespace astro::robot
