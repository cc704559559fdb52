#pragma once

#include <array>

#include "hal/sim/chassis.hpp"
#include "hal/sim/config.hpp"
#include "hal/sim/drivetrain.hpp"
#include "hal/sim/encoder.hpp"
#include "hal/sim/gyro.hpp"
#include "hal/sim/restart_slip.hpp"
#include "hal/sim/slip.hpp"
#include "host/emulator/chip/adc.hpp"
#include "host/emulator/chip/decoders.hpp"
#include "host/emulator/chip/flexpwm.hpp"
#include "host/emulator/chip/gpio.hpp"
#include "host/emulator/chip/iomuxc.hpp"

namespace astro::emulator {

/// The robot around the chip: motors, wheels and floor of hal/sim. The chip's pins are the inputs of the
/// motor driver chip, and the encoders' edges go to other pins. Moves once a millisecond, as hal/sim does.
class World : public Model {
 public:
  struct Wires {
    const FlexPwm& pwm;
    Gpio& gpio7;
    EncoderWires& encoders;
    Adc& adc;
    const Iomuxc& pads;
  };

  World(Machine& machine, const sim::Config& config, const Wires& wires);

  // It has no registers, but takes part in events.
  std::uint32_t read(std::uint32_t) override { return 0; }
  void write(std::uint32_t, std::uint32_t) override {}
  void event() override;
  void reset() override;

  sim::Pose truth() const { return chassis_.pose(); }
  /// What a gyro on the robot measures about its own axes.
  std::array<double, 3> gyro_radps();
  /// Turns the robot so that no wheel notices, as long as time goes by.
  void turn_body(double rate_radps) { turning_radps_ = rate_radps; }
  const sim::Drivetrain& drivetrain() const { return drivetrain_; }
  void set_load(Side side, const sim::WheelLoad& load) { drivetrain_.set_load(side, load); }
  void set_supply_V(double volts) { supply_V_ = volts; }
  /// Sets or clears a fault of the driver chip, which then pulls its error output down and opens both
  /// bridges.
  void set_driver_fault(bool fault);
  /// Unplugs one encoder's cable; its counts are lost.
  void unplug(Side side, bool unplugged) { unplugged_[at(side)] = unplugged; }

  /// State of the bridges by side: signed duty, and whether they are open.
  struct Bridges {
    sim::Pair duty{};
    std::array<bool, 2> open{};
  };
  Bridges bridges() const;

 private:
  void move();
  std::array<std::int32_t, 2> edges(const sim::Pair& wheels_rad);

  Machine& machine_;
  sim::Config config_;
  Wires wires_;
  sim::Drivetrain drivetrain_;
  std::array<sim::Slip, 2> slip_;
  sim::RestartSlip restart_slip_;
  sim::Chassis chassis_;
  sim::Encoders shafts_;
  sim::Gyro gyro_;
  double turning_radps_ = 0;
  double supply_V_;
  std::array<bool, 2> unplugged_{};
  bool fault_ = false;
};

}  // namespace astro::emulator
