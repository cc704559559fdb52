#include "host/page/calls/simulated_robot.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "host/page/calls/question.hpp"

namespace astro::page {

sim::Config simulated_robot_in(const nlohmann::json& question) {
  const auto within = [&](const char* name, double usual, double least, double most) {
    return number_in(question, name, least, most).value_or(usual);
  };
  simulation::RobotOptions options;
  options.seed = static_cast<std::uint64_t>(within("seed", 1, 0, 1e9));
  options.true_ed = within("E_d", options.true_ed, 0.9, 1.1);
  options.true_wheelbase_m = within("E_b", 0.99521, 0.9, 1.1) * sim::Config().nominal_wheelbase_m;
  options.scale = within("S", 1, 0.9, 1.1);
  options.true_e = within("e", 0, -0.1, 0.2);
  options.slip_m *= within("slip", 1, 0, 1000);
  options.counts_per_motor_rev = within("counts_per_motor_rev", options.counts_per_motor_rev, 1, 100'000);
  options.wiring_faults = texts_in(question, "wiring");
  return config_of(options);
}

}  // namespace astro::page
