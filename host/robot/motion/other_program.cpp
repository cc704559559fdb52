#include "host/robot/motion/other_program.hpp"

#include "host/robot/sharing/port_socket.hpp"

namespace astro::robot {

PortUsers port_users(Client& client) {
  try {
    return client.request(GetPortUsers{}, {.timeout = std::chrono::milliseconds(60), .tries = 3});
  } catch (const Error&) {
    return {};
  }
}

std::string another_program(std::uint32_t pid, const CommandLine& command) {
  return pid == 0 ? "another program" : "another program (" + in_words(pid, command.view()) + ")";
}

}  // namespace astro::robot
