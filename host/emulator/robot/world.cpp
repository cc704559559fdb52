#include "host/emulator/robot/world.hpp"

#include "common/fixed/wrapping.hpp"
#include "hal/sim/encoder.hpp"

namespace astro::emulator {
namespace {

constexpr Cycles kStep = 1000 * kCyclesPerMicrosecond;
constexpr double kDivider = 10.0 / (82.0 + 10.0);  // 82 kohm over 10 kohm before pin 14
constexpr std::uint32_t kErrorPin = 1U << 16;      // pin 8, GPIO7

/// IN1 and IN2 of each channel: a pin of GPIO7, and the register that selects the function of its pad.
struct Pin {
  std::uint32_t bit, mux;
};
struct Inputs {
  Pin forward, reverse;
};
constexpr std::array<Inputs, 2> kInputs{{{{1U << 0, teensy40::iomuxc::SW_MUX_CTL_PAD_GPIO_B0_00.value},
                                          {1U << 1, teensy40::iomuxc::SW_MUX_CTL_PAD_GPIO_B0_01.value}},
                                         {{1U << 2, teensy40::iomuxc::SW_MUX_CTL_PAD_GPIO_B0_02.value},
                                          {1U << 17, teensy40::iomuxc::SW_MUX_CTL_PAD_GPIO_B1_01.value}}}};

}  // namespace

World::World(Machine& machine, const sim::Config& config, const Wires& wires)
    : machine_(machine),
      config_(config),
      wires_(wires),
      drivetrain_(config),
      slip_{sim::Slip(config.seed, 0, config.slip_m), sim::Slip(config.seed, 1, config.slip_m)},
      restart_slip_(config.restart_slip_rad),
      chassis_(sim::true_geometry(config)),
      shafts_(config),
      gyro_(config),
      supply_V_(config.supply_V) {
  wires_.adc.pin_V = [this] { return drivetrain_.bus_V() * kDivider; };
}

/// The chip restarts; the world goes on.
void World::reset() { machine_.wake(*this, machine_.now() + kStep); }

void World::set_driver_fault(bool fault) {
  fault_ = fault;
  wires_.gpio7.set_inputs(fault ? ~kErrorPin : ~0U);
}

/// Truth table of the TB67H420FTG: one input high drives while PWM is high and brakes while it is low; both
/// low open the bridge; both high brake.
World::Bridges World::bridges() const {
  Bridges bridges;
  constexpr std::uint32_t kGpio = 5;
  const auto high = [this](const Pin& pin) {  // a pad that is not connected to the port is low: pull-down
    return (wires_.gpio7.driven() & pin.bit) != 0 && wires_.pads.function(pin.mux) == kGpio;
  };
  for (std::size_t side = 0; side < 2; ++side) {
    const bool forward = high(kInputs[side].forward), reverse = high(kInputs[side].reverse);
    bridges.open[side] = fault_ || (!forward && !reverse);
    if (forward != reverse) bridges.duty[side] = forward ? wires_.pwm.duty(side) : -wires_.pwm.duty(side);
  }
  return bridges;
}

std::array<std::int32_t, 2> World::edges(const sim::Pair& wheels_rad) {
  const hal::EncoderCounts before = shafts_.read();
  shafts_.turn(wheels_rad);
  const hal::EncoderCounts after = shafts_.read();
  return {wrapping_difference(after.left, before.left), wrapping_difference(after.right, before.right)};
}

std::array<double, 3> World::gyro_radps() {
  std::array<double, 3> radps{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    radps[axis] = gyro_.read().rate[axis] * sim::Gyro::kCount_radps;
  return radps;
}

void World::event() {
  machine_.wake(*this, machine_.now() + kStep);
  move();
  if (turning_radps_ != 0) chassis_.jump(turning_radps_ * 1e-3);
  if (gyro_.exists()) gyro_.advance(chassis_.pose().theta_rad);
}

void World::move() {
  const Bridges now = bridges();
  sim::Drive drive{.supply_V = supply_V_, .supply_ohm = config_.supply_ohm};
  const auto& wiring = config_.wiring;
  drive.duty = wiring.motors_swapped ? sim::Pair{now.duty[1], now.duty[0]} : now.duty;
  drive.open = wiring.motors_swapped ? std::array{now.open[1], now.open[0]} : now.open;
  drive.open = {drive.open[0] || wiring.left_motor_dead, drive.open[1] || wiring.right_motor_dead};
  if (wiring.left_motor_reversed) drive.duty[0] = -drive.duty[0];
  if (wiring.right_motor_reversed) drive.duty[1] = -drive.duty[1];
  const sim::Pair wheels_rad = drivetrain_.advance_tick(drive);
  const sim::Geometry geometry = sim::true_geometry(config_);
  const sim::Pair rolled_m{wheels_rad[0] * geometry.diameter_m[0] / 2,
                           wheels_rad[1] * geometry.diameter_m[1] / 2};
  if (!config_.on_stand) chassis_.jump(restart_slip_.advance(rolled_m[0], rolled_m[1]));
  if (wheels_rad[0] == 0.0 && wheels_rad[1] == 0.0) return;
  const auto counted = edges(wheels_rad);
  for (std::size_t side = 0; side < 2; ++side)
    if (!unplugged_[side]) wires_.encoders.count(side, counted[side]);
  if (config_.on_stand) return;
  chassis_.advance(slip_[0].travel(rolled_m[0]), slip_[1].travel(rolled_m[1]), rolled_m[0], rolled_m[1]);
}

}  // namespace astro::emulator
