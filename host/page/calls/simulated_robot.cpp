#include "host/page/calls/simulated_robot.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "host/page/calls/question.hpp"

namespace astro::page {

sim::Config simulated_robot_in(const nlohmann::json& question) {
  const auto within = [&](const char* name, double usual, double least, double most) {
    return number_in(question, name, least, most).value_or(usual);
  };
  sim::Config config;
  config.seed = static_cast<std::uint64_t>(within("seed", 1, 0, 1e9));
  config.true_ed = within("E_d", 1.00416, 0.9, 1.1);
  config.true_wheelbase_m = within("E_b", 0.99521, 0.9, 1.1) * config.nominal_wheelbase_m;
  config.scale = within("S", 1, 0.9, 1.1);
  config.true_e = within("e", 0, -0.1, 0.2);
  config.slip_m *= within("slip", 1, 0, 1000);
  return config;
}

}  // namespace astro::page
