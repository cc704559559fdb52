#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace astro::commands {

/// One line about this computer.
struct Finding {
  enum class Kind : std::uint8_t { works, missing, fails };
  Kind kind = Kind::works;
  std::string what, details;  // details: for what is missing what it is for and how to get it
};

/// Other programs and files that only some jobs need, and the rights to the serial ports that are here. Opens no port and
/// starts no program.
std::vector<Finding> look_at_machine();

}  // namespace astro::commands
