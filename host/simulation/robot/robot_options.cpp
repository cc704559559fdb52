#include "host/simulation/robot/robot_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hal/sim/board.hpp"
#include "host/base/error.hpp"

namespace astro::simulation {
namespace {

struct WiringFault {
  const char* name;
  bool sim::Wiring::*flag;
};

constexpr WiringFault kWiringFaults[] = {
    {"left-motor-reversed", &sim::Wiring::left_motor_reversed},
    {"right-motor-reversed", &sim::Wiring::right_motor_reversed},
    {"motors-swapped", &sim::Wiring::motors_swapped},
    {"left-motor-dead", &sim::Wiring::left_motor_dead},
    {"right-motor-dead", &sim::Wiring::right_motor_dead},
    {"left-encoder-reversed", &sim::Wiring::left_encoder_reversed},
    {"right-encoder-reversed", &sim::Wiring::right_encoder_reversed},
    {"encoders-swapped", &sim::Wiring::encoders_swapped},
    {"left-encoder-dead", &sim::Wiring::left_encoder_dead},
    {"right-encoder-dead", &sim::Wiring::right_encoder_dead},
    {"left-channel-lost", &sim::Wiring::left_channel_lost},
    {"right-channel-lost", &sim::Wiring::right_channel_lost},
};

constexpr double kWallUnevenness_m = 3e-4;

sim::Wiring wiring_with(const std::vector<std::string>& faults) {
  sim::Wiring wiring;
  for (const std::string& name : faults) {
    const auto* const fault = std::ranges::find(kWiringFaults, name, &WiringFault::name);
    if (fault == std::end(kWiringFaults)) throw Error(wrong_wiring_fault(name));
    wiring.*fault->flag = true;
  }
  return wiring;
}

}  // namespace

std::string wiring_fault_names() {
  std::string names;
  for (const WiringFault& fault : kWiringFaults)
    names += (names.empty() ? "" : ", ") + std::string(fault.name);
  return names;
}

std::string wrong_wiring_fault(const std::string& name) {
  if (std::ranges::find(kWiringFaults, name, &WiringFault::name) != std::end(kWiringFaults)) return {};
  return fmt::format("'{}' is not a wiring fault; choose from {}", name, wiring_fault_names());
}

sim::Config config_of(const RobotOptions& options) {
  sim::Config config;
  config.true_wheelbase_m = options.true_wheelbase_m;
  config.true_ed = options.true_ed;
  config.true_e = options.true_e;
  config.true_kappa0 = options.true_kappa0;
  config.scale = options.scale;
  config.slip_m = options.slip_m;
  config.restart_slip_rad = options.restart_slip_rad;
  config.counts_per_motor_rev = options.counts_per_motor_rev;
  config.motor_mismatch = options.motor_mismatch;
  config.on_stand = options.on_stand;
  if (options.gyro) config.gyro.emplace();
  config.wiring = wiring_with(options.wiring_faults);
  if (options.wall_ahead_m)
    config.wall = sim::WallConfig{.x_m = config.body.ahead_m + *options.wall_ahead_m,
                                  .unevenness_m = kWallUnevenness_m};
  config.seed = options.seed;
  return config;
}

std::size_t flash_bytes() { return sim::Flash::kBytes; }

}  // namespace astro::simulation
