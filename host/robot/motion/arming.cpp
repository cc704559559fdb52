#include "host/robot/motion/arming.hpp"

#include "host/robot/client/robot_problem.hpp"
#include "host/robot/motion/drive_problem.hpp"

namespace astro::robot {

DriveFault::DriveFault(const std::string& sentence, Fault fault, std::vector<std::string> values)
    : Error(sentence, RobotProblem::faulted, std::move(values)), fault_(fault) {}

Fault first_fault(std::uint32_t mask) {
  for (unsigned i = 1; i < 32; ++i) {
    if (((mask >> i) & 1U) != 0) return static_cast<Fault>(i);
  }
  return Fault::none;
}

std::optional<Remark> clear_faults_left_behind(Client& client, const std::function<void()>& comes_to_rest,
                                               RetryPolicy patience) {
  constexpr std::uint32_t kLeftBehind = bit(Fault::command_timeout) | bit(Fault::link_lost);
  const auto left_behind = [&] {
    const std::uint32_t latched = client.request(protocol::GetFaults{}, patience).latched;
    if ((latched & ~kLeftBehind) != 0)
      throw DriveFault("the robot is not armed because of a latched fault: " + fault_names(latched),
                       first_fault(latched & ~kLeftBehind), {fault_names(latched)});
    return latched;
  };
  if (left_behind() == 0) return std::nullopt;
  comes_to_rest();
  const std::string faults = fault_names(left_behind());  // another may have come while the robot ramped down
  client.request(protocol::ClearFaults{}, patience);
  return Remark{"cleared " + faults + ", which an earlier drive left behind",
                DriveProblem::faults_left_behind,
                {faults}};
}

}  // namespace astro::robot
