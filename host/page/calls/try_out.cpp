#include "host/page/calls/try_out.hpp"

#include <memory>
#include <nlohmann/json.hpp>

#include "host/page/calls/simulated_robot.hpp"
#include "host/page/calls/watched_experiment.hpp"
#include "host/robot/client/client.hpp"
#include "host/simulation/robot/in_process.hpp"

namespace astro::page {
namespace {

using nlohmann::json;

/// The factors with which this robot's odometry would make no systematic error.
json exact_factors(const sim::Config& config) {
  const sim::Geometry built = true_geometry(config);
  return {{"c_R", built.diameter_m[1] / config.nominal_diameter_m},
          {"c_L", built.diameter_m[0] / config.nominal_diameter_m},
          {"b_m", built.wheelbase_m},
          {"e", built.e}};
}

}  // namespace

json try_out(const json& question, const std::filesystem::path& folder, const Emit& emit) {
  const sim::Config config = simulated_robot_in(question);
  const experiment::Plan plan = plan_in(question);
  const auto robot =
      std::make_shared<simulation::VirtualRobot>(config, simulation::MocapConfig{.seed = config.seed});
  robot::Client client(std::make_unique<simulation::InProcessTransport>(robot));
  client.connect();
  json told = watched_experiment(client, robot, plan, folder, "try", emit);
  told["built"] = exact_factors(config);
  return told;
}

}  // namespace astro::page
