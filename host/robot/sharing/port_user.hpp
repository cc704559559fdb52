#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// The programs at a shared port.
namespace astro::robot {

/// One program.
struct PortUser {
  std::uint32_t pid = 0;
  std::string command;
};

/// "process id 12, 'astrolabe drive line 2'".
std::string in_words(std::uint32_t pid, std::string_view command);

/// The relay's number for one connection of a program. Numbers are not used again.
using SessionId = int;

}  // namespace astro::robot
