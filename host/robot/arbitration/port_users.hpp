#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "common/base/text.hpp"
#include "common/protocol/field.hpp"

/// The programs at a shared port, and the message by which one asks who else is there. Its id is one of those
/// of host/robot/sharing/relay_messages.hpp, which never go to the robot.
namespace astro::robot {

/// One program.
struct PortUser {
  std::uint32_t pid = 0;
  std::string command;
};

/// The relay's number for one connection of a program. Numbers are not used again.
using SessionId = int;

/// A program's command line, cut to fit.
using CommandLine = Text<96>;

/// The reply to GetPortUsers; process id 0: none.
struct PortUsers {
  std::uint32_t driver_pid = 0;
  CommandLine driver_command{};
  std::uint32_t stopper_pid = 0;
  CommandLine stopper_command{};

  static constexpr std::uint8_t kId = 0x41;
  static constexpr std::string_view kName = "PortUsers";
  static constexpr std::string_view kDoc = "Who drives through this port, and who ended the asker's drive.";
  static constexpr std::tuple kFields{
      protocol::Field{&PortUsers::driver_pid, "driver_pid", "", "whose motion requests are taken"},
      protocol::Field{&PortUsers::driver_command, "driver_command", "", "its command line"},
      protocol::Field{&PortUsers::stopper_pid, "stopper_pid", "", "who stopped the asker's drive"},
      protocol::Field{&PortUsers::stopper_command, "stopper_command", "", "its command line"},
  };
};

struct GetPortUsers {
  using Reply = PortUsers;
  static constexpr std::uint8_t kId = 0x40;
  static constexpr std::string_view kName = "GetPortUsers";
  static constexpr std::string_view kDoc = "Asks the program that holds the port who else is there.";
  static constexpr std::tuple<> kFields{};
};

}  // namespace astro::robot
