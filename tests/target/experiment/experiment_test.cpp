#include "host/experiment/experiment.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/emulator/emulated_robot.hpp"
#include "tests/support/desk.hpp"

namespace astro::emulator {
namespace {

constexpr const char* kImage = ASTRO_IMAGE_DIR "/astrolabe-teensy40.hex";

/// The emulated Teensy on the thesis's robot, as support::Desk is the simulated one.
struct EmulatedDesk {
  explicit EmulatedDesk(const sim::Config& config)
      : robot(std::make_shared<EmulatedRobot>(kImage, config, simulator::MocapConfig{.seed = config.seed})),
        client(std::make_unique<PortTransport>(robot, Port::serial)),
        truth(robot) {
    client.connect();
  }
  std::shared_ptr<EmulatedRobot> robot;
  link::Client client;
  EmulatedTruth truth;
};

experiment::Plan squares(int runs) {
  experiment::Plan plan;
  plan.runs = runs;
  plan.rounds = 1;
  plan.extras = false;
  plan.truth = "sim";
  return plan;
}

TEST(ExperimentOnTheImage, CalibratesTheThesisRobotAsTheSimulatedOneIs) {
  const sim::Config config = support::thesis_robot(0, 1);
  const support::TemporaryFolder folder, emulated_folder;
  support::Desk desk(config);
  const auto simulated = experiment::run_experiment(desk.client, desk.truth, squares(1), folder.path(), {});
  EmulatedDesk emulated(config);
  const auto start = std::chrono::steady_clock::now();
  const auto results =
      experiment::run_experiment(emulated.client, emulated.truth, squares(1), emulated_folder.path(), {});
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print("E_max_syst: simulated robot {:.1f} -> {:.2f} mm, emulated Teensy {:.1f} -> {:.2f} mm\n",
             1000 * simulated.before().summary.E_max_syst_m, 1000 * simulated.after().summary.E_max_syst_m,
             1000 * results.before().summary.E_max_syst_m, 1000 * results.after().summary.E_max_syst_m);
  fmt::print("{:.0f} s of virtual time in {:.1f} s: {:.1f} times real time\n",
             static_cast<double>(emulated.robot->teensy().now_us()) / 1e6, took_s,
             static_cast<double>(emulated.robot->teensy().now_us()) / 1e6 / took_s);
  EXPECT_GT(results.before().summary.E_max_syst_m, 0.3);
  EXPECT_LT(results.after().summary.E_max_syst_m, results.before().summary.E_max_syst_m / 20);
}

}  // namespace
}  // namespace astro::emulator
