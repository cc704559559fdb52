#pragma once

#include <cstdint>
#include <string>

/// The programs at a shared port.
namespace astro::robot {

/// One program.
struct PortUser {
  std::uint32_t pid = 0;
  std::string command;
};

/// The relay's number for one connection of a program. Numbers are not used again.
using SessionId = int;

}  // namespace astro::robot
