#include "host/robot/client/discovery.hpp"

#include <future>

#include "host/robot/client/client.hpp"

namespace astro::robot {

namespace {

FoundPort ask(SharedPorts& ports, const Port& port, microseconds timeout, unsigned baud) {
  constexpr int kTries = 2;  // the first may be lost among old bytes that the robot received before
  FoundPort result{port, std::nullopt, {}};
  try {
    Client client(ports.open(port.address, baud));
    result.robot = client.connect({timeout / kTries, kTries});
  } catch (const Error& error) {
    result.reason = error.remark();
  }
  return result;
}

}  // namespace

std::vector<FoundPort> find_robots(SharedPorts& shared, const std::vector<Port>& ports, microseconds timeout,
                                   unsigned baud) {
  std::vector<std::future<FoundPort>> answers;
  for (const Port& port : ports)
    answers.push_back(std::async(std::launch::async, [&] { return ask(shared, port, timeout, baud); }));
  std::vector<FoundPort> found;
  for (std::future<FoundPort>& answer : answers) found.push_back(answer.get());
  return found;
}

}  // namespace astro::robot
