#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/safety/fault.hpp"
#include "host/base/error.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/client/refusal.hpp"

/// What every program that arms a robot has to keep, beside the rules of the robot itself.
namespace astro::robot {

/// The robot stopped because of a fault, or cannot be armed because of a latched one.
class DriveFault : public Error {
 public:
  DriveFault(const std::string& sentence, Fault fault, std::vector<std::string> values);
  Fault fault() const { return fault_; }

 private:
  Fault fault_;
};

/// The first fault of a mask of latched ones; none if it is 0.
Fault first_fault(std::uint32_t mask);

/// Clears the faults that stay latched if a program ends or loses its link while the robot drives: command_timeout and
/// link_lost. A person has to clear any other. `comes_to_rest` waits until the robot no longer powers its motors, because it
/// still ramps down if its host died a moment ago; it is called only if there is something to clear.
///
/// Returns what was cleared, as a notice. Throws DriveFault for any other latched fault, and then clears nothing; all that
/// `comes_to_rest` and Client::request throw.
std::optional<Remark> clear_faults_left_behind(Client& client, const std::function<void()>& comes_to_rest,
                                               RetryPolicy patience = {});

}  // namespace astro::robot
