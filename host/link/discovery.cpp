#include "host/link/discovery.hpp"

#include "host/link/client.hpp"
#include "host/link/shared_port.hpp"

namespace astro::link {

std::vector<FoundPort> find_robots(const std::vector<Port>& ports, microseconds timeout, unsigned baud) {
  constexpr int kTries = 2;  // the first may end in what the robot received before
  std::vector<FoundPort> found;
  for (const Port& port : ports) {
    FoundPort result{port, std::nullopt, {}};
    try {
      Client client(open_shared_port(port.address, baud));
      result.robot = client.connect({timeout / kTries, kTries});
    } catch (const Error& error) {
      result.reason = error.what();
    }
    found.push_back(std::move(result));
  }
  return found;
}

std::vector<FoundPort> find_robots(microseconds timeout) { return find_robots(candidate_ports(), timeout); }

}  // namespace astro::link
