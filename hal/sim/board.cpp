#include "hal/sim/board.hpp"

namespace astro::sim {

Board::Board(const Config& config)
    : radius_m_{true_geometry(config).diameter_m[0] / 2.0, true_geometry(config).diameter_m[1] / 2.0},
      on_stand_(config.on_stand),
      encoders_(config),
      motors_(config.wiring),
      battery_(config),
      flash_(config.flash),
      system_(config.seed, clock_, motors_),
      drivetrain_(config),
      slip_{Slip(config.seed, at(Side::left), config.slip_m),
            Slip(config.seed, at(Side::right), config.slip_m)},
      restart_slip_(config.restart_slip_rad),
      chassis_(true_geometry(config)) {}

void Board::advance_tick() {
  clock_.advance_us(kTick_us);
  world_us_ += kTick_us;
  const Pair wheels_rad = drivetrain_.advance_tick(motors_.at_wheels(battery_));
  battery_.observe(drivetrain_.bus_V());
  if (!on_stand_)
    chassis_.jump(restart_slip_.advance(wheels_rad[0] * radius_m_[0], wheels_rad[1] * radius_m_[1]));
  if (wheels_rad[0] != 0.0 || wheels_rad[1] != 0.0) roll(wheels_rad);
}

void Board::roll(const Pair& wheels_rad) {
  encoders_.turn(wheels_rad);
  if (on_stand_) return;
  const Pair rolled_m{wheels_rad[0] * radius_m_[0], wheels_rad[1] * radius_m_[1]};
  chassis_.advance(slip_[0].travel(rolled_m[0]), slip_[1].travel(rolled_m[1]), rolled_m[0], rolled_m[1]);
}

void Board::restart(hal::ResetCause cause) {
  clock_.restart();
  encoders_.preset({});
  motors_.coast();
  ports_.clear();
  system_.restart(cause);
}

}  // namespace astro::sim
