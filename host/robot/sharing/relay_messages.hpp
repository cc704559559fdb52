#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>

#include "common/base/text.hpp"
#include "common/protocol/enums.hpp"
#include "common/protocol/field.hpp"
#include "host/base/error.hpp"
#include "host/robot/sharing/port_user.hpp"

/// Messages between programs that share a port, in addition to the robot's protocol. None of them goes to the
/// robot. Their ids, 0x40 to 0x43, lie between its requests and its replies, where the protocol has none: a
/// robot refuses the request as unknown, and a program that does not know the events drops them.
namespace astro::robot {

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
  static constexpr std::string_view kDoc =
      "Who drives through this port, and who ended the drive of the program that asks.";
  static constexpr std::tuple kFields{
      protocol::Field{&PortUsers::driver_pid, "driver_pid", "", "whose motion requests are taken"},
      protocol::Field{&PortUsers::driver_command, "driver_command", "", "its command line"},
      protocol::Field{&PortUsers::stopper_pid, "stopper_pid", "",
                      "who stopped the drive of the program that asks"},
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

/// The first frame on each connection: the program that holds the port is running. An event.
struct Welcome {
  static constexpr std::uint8_t kId = 0x42;
  static constexpr std::string_view kName = "Welcome";
  static constexpr std::string_view kDoc = "The program that holds the port serves this connection.";
  static constexpr std::tuple<> kFields{};
};

/// Why a connection ends. Also the kind of the LinkLost that a program gets, whose value is the port's
/// address.
enum class FarewellReason : std::uint8_t { line_lost, reads_too_slowly, too_many, holder_ended };
inline constexpr std::array<std::string_view, 4> kFarewellReasonNames{"line_lost", "reads_too_slowly",
                                                                      "too_many", "holder_ended"};
constexpr std::span<const std::string_view> names(FarewellReason) { return kFarewellReasonNames; }

/// The clause after "lost PORT: ".
constexpr std::string_view fact(FarewellReason reason) {
  switch (reason) {
    case FarewellReason::line_lost:
      return "it was unplugged, switched off or ended";
    case FarewellReason::reads_too_slowly:
      return "this program did not read what the robot sent, so the program that holds the port has "
             "disconnected it";
    case FarewellReason::too_many:
      return "too many programs use it at once: end some of them";
    case FarewellReason::holder_ended:
      return "the program that held the port has ended";
  }
  return "the program that holds the port has disconnected this one";
}

/// The last frame on a connection that the holder ends. An event.
struct Farewell {
  FarewellReason reason{};

  static constexpr std::uint8_t kId = 0x43;
  static constexpr std::string_view kName = "Farewell";
  static constexpr std::string_view kDoc = "The connection ends here.";
  static constexpr std::tuple kFields{
      protocol::Field{&Farewell::reason, "reason", "", "why"},
  };
};

}  // namespace astro::robot
