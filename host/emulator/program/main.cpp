#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/cli/console.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/options.hpp"
#include "host/cli/sim_options.hpp"
#include "host/cli/wrong_usage.hpp"
#include "host/emulator/emulated_robot.hpp"

namespace {

using namespace astro;  // NOLINT(google-build-using-namespace): a program's own file
namespace fs = std::filesystem;

/// An emulated Teensy whose bootloader always finds somebody who flashes the same file again.
class ServedTeensy : public simulator::Served {
 public:
  ServedTeensy(fs::path hex, sim::Config config, const simulator::MocapConfig& mocap)
      : hex_(std::move(hex)), config_(std::move(config)), mocap_(mocap) {
    start();
  }

  void step() override {
    constexpr int kStepsPerMillisecond = 5;
    for (int i = 0; i < kStepsPerMillisecond; ++i) robot_->step();
    if (robot_->teensy().in_bootloader()) load_again();
  }
  std::uint64_t now_us() override { return robot_->teensy().now_us(); }
  std::size_t room() override {
    constexpr std::size_t kUnderway = 1024;  // what a USB adapter of the serial port holds
    return kUnderway - std::min(kUnderway, robot_->teensy().serial().underway());
  }
  void write(std::span<const std::uint8_t> bytes) override { robot_->teensy().serial().send(bytes); }
  std::size_t read(std::span<std::uint8_t> into) override { return robot_->read_serial(into); }
  std::vector<recording::TruthSample> take_truth() override { return robot_->take_truth(); }
  std::span<const std::uint8_t> flash() override { return robot_->teensy().flash().parameters(); }

 private:
  void start() { robot_ = std::make_unique<emulator::EmulatedRobot>(hex_, config_, mocap_); }
  void load_again() {
    const auto kept = flash();
    config_.flash.assign(kept.begin(), kept.end());
    start();
  }

  fs::path hex_;
  sim::Config config_;
  simulator::MocapConfig mocap_;
  std::unique_ptr<emulator::EmulatedRobot> robot_;
};

void run(const fs::path& hex, cli::SimOptions& options) {
  cli::prepare(options, emulator::NorFlash::kParametersEnd - emulator::NorFlash::kParameters);
  options.robot.flash = simulator::load_flash(options.server.flash);
  simulator::MocapConfig mocap;
  mocap.seed = options.robot.seed;
  simulator::Server server(std::make_unique<ServedTeensy>(hex, options.robot, mocap), options.server);
  cli::serve(server, "an emulated robot");
}

int run(int argc, char** argv) {
  CLI::App app("Runs a robot's firmware image on an emulated Teensy 4.0 behind a pseudo terminal.",
               "astrolabe-emulator");
  fs::path hex;
  cli::SimOptions options;
  app.add_option("firmware", hex, "image for the Teensy 4.0, as './dev firmware' builds it")
      ->type_name("HEX")
      ->required();
  cli::add_sim_options(app, options);
  cli::examples(app,
                {"astrolabe-emulator build/teensy40/bin/astrolabe-teensy40.hex --pty /tmp/robot --fast"});
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wish) {
    return app.exit(wish);  // --help
  } catch (const CLI::ParseError& error) {
    cli::complain(cli::sentence_for(app, error, argc, argv));
    return 2;
  }
  run(hex, options);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  cli::watch_for_interrupt();
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    cli::complain(error.what());
    return 1;
  }
}
