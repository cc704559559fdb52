#include "host/robot/client/discovery.hpp"

#include <future>

#include "host/robot/client/client.hpp"
#include "host/robot/sharing/shared_port.hpp"

namespace astro::robot {

namespace {

FoundPort ask(const Port& port, microseconds timeout, unsigned baud) {
  constexpr int kTries = 2;  // the first may be lost among old bytes that the robot received before
  FoundPort result{port, std::nullopt, {}};
  try {
    Client client(open_shared_port(port.address, baud));
    result.robot = client.connect({timeout / kTries, kTries});
  } catch (const Error& error) {
    result.reason = error.remark();
  }
  return result;
}

}  // namespace

std::vector<FoundPort> find_robots(const std::vector<Port>& ports, microseconds timeout, unsigned baud) {
  std::vector<std::future<FoundPort>> answers;
  for (const Port& port : ports)
    answers.push_back(std::async(std::launch::async, [&] { return ask(port, timeout, baud); }));
  std::vector<FoundPort> found;
  for (std::future<FoundPort>& answer : answers) found.push_back(answer.get());
  return found;
}

std::vector<FoundPort> find_robots(microseconds timeout) { return find_robots(candidate_ports(), timeout); }

}  // namespace astro::robot
