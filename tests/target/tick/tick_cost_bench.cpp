#include <fmt/format.h>

#include <chrono>

#include "host/emulator/robot/emulated_robot.hpp"
#include "host/experiment/drive/experiment.hpp"
#include "host/simulation/robot/in_process.hpp"
#include "tests/support/robots/desk.hpp"
#include "tests/target/firmware_file.hpp"
#include "tests/target/tick/tick_profile.hpp"

/// The UMBmark experiment through the image: what a tick costs by part, and how fast the emulator is.
namespace {

using namespace astro;

using target::kImage;

experiment::Results run(const std::shared_ptr<emulator::EmulatedRobot>& robot, int runs) {
  const support::TemporaryFolder folder;
  robot::Client client(std::make_unique<emulator::PortTransport>(robot, emulator::Port::serial));
  simulation::CameraTruth truth(robot);
  client.connect();
  experiment::Plan plan;
  plan.runs = runs;
  plan.rounds = 1;
  plan.extras = false;
  plan.truth = "sim";
  return experiment::run_experiment(client, truth, plan, folder.path(), {});
}

std::shared_ptr<emulator::EmulatedRobot> thesis_robot() {
  return std::make_shared<emulator::EmulatedRobot>(kImage, support::thesis_robot(support::kThesisSlip_m, 1),
                                                   simulation::MocapConfig{});
}

}  // namespace

int main() {
  {
    const auto robot = thesis_robot();
    target::TickProfile profile(robot->teensy(), ASTRO_IMAGE_DIR "/astrolabe-teensy40.elf");
    run(robot, 1);
    profile.print(350);
  }
  const auto robot = thesis_robot();
  const auto begun = std::chrono::steady_clock::now();
  const auto results = run(robot, 5);
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  const double virtual_s = static_cast<double>(robot->teensy().now_us()) / 1e6;
  fmt::print(
      "whole experiment through the image, 5+5 squares twice: E_max_syst {:.1f} -> {:.1f} mm, {:.1f} times "
      "smaller\n",
      1000 * results.before().summary.E_max_syst_m, 1000 * results.after().summary.E_max_syst_m,
      results.improvement());
  fmt::print("emulator: {:.0f} s of virtual time in {:.1f} s, {:.1f} x real time (bar 5)\n", virtual_s,
             took_s, virtual_s / took_s);
}
