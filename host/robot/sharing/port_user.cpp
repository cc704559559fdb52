#include "host/robot/sharing/port_user.hpp"

namespace astro::robot {

std::string in_words(std::uint32_t pid, std::string_view command) {
  return "process id " + std::to_string(pid) +
         (command.empty() ? std::string() : ", '" + std::string(command) + "'");
}

}  // namespace astro::robot
