#include "hal/sim/board.hpp"

#include <algorithm>
#include <cmath>

namespace astro::sim {

Board::Board(const Config& config)
    : radius_m_{true_geometry(config).diameter_m[0] / 2.0, true_geometry(config).diameter_m[1] / 2.0},
      on_stand_(config.on_stand),
      encoders_(config),
      motors_(config.wiring),
      battery_(config),
      flash_(config.flash),
      system_(identity_of(config), clock_, motors_),
      drivetrain_(config),
      slip_{Slip(config.seed, at(Side::left), config.slip_m),
            Slip(config.seed, at(Side::right), config.slip_m)},
      restart_slip_(config.restart_slip_rad),
      chassis_(true_geometry(config)),
      gyro_(config),
      wheelbase_m_(config.true_wheelbase_m),
      grip_N_(config.grip_N) {
  if (config.wall && !on_stand_) wall_.emplace(*config.wall, config.body, config.seed);
}

void Board::advance_tick() {
  clock_.advance_us(kTick_us);
  world_us_ += kTick_us;
  const Drive drive = motors_.at_wheels(battery_);
  if (wall_) [[unlikely]] {
    lean_on_wall();
    note_stalls(drive);
  }
  const Pair wheels_rad = drivetrain_.advance_tick(drive);
  battery_.observe(drivetrain_.bus_V());
  if (!on_stand_)
    chassis_.jump(restart_slip_.advance(wheels_rad[0] * radius_m_[0], wheels_rad[1] * radius_m_[1]));
  if (wheels_rad[0] != 0.0 || wheels_rad[1] != 0.0) roll(wheels_rad);
  if (gyro_.exists()) [[unlikely]]
    gyro_.advance(chassis_.pose().theta_rad);
}

// The tyres hand the wall's force on to the wheels, as far as they grip. A tyre that skids moves the body no further and holds its
// wheel back with all of its grip, until the wheel has nearly stopped or turns back.
void Board::lean_on_wall() {
  constexpr double kSticks_mps = 0.005;
  Pair rim_mps{}, ground_mps{};
  for (std::size_t k = 0; k < 2; ++k) {
    rim_mps[k] = drivetrain_.speed_radps()[k] * radius_m_[k];
    if (rim_mps[k] * skids_[k] <= kSticks_mps) skids_[k] = 0;
    ground_mps[k] = skids_[k] == 0 ? rim_mps[k] : 0;
  }
  const WallForce wall = wall_->force(chassis_.pose(), (ground_mps[0] + ground_mps[1]) / 2,
                                      (ground_mps[1] - ground_mps[0]) / wheelbase_m_);
  pressing_N_ = wall.pressing_N;
  wall_record_.hardest_N = std::max(wall_record_.hardest_N, pressing_N_);
  const Pair on_tyre_N{wall.forward_N / 2 - wall.turning_Nm / wheelbase_m_,
                       wall.forward_N / 2 + wall.turning_Nm / wheelbase_m_};
  for (const Side side : {Side::left, Side::right}) {
    const std::size_t k = at(side);
    if (std::abs(on_tyre_N[k]) > grip_N_ && on_tyre_N[k] * rim_mps[k] < 0)
      skids_[k] = -std::copysign(1.0, on_tyre_N[k]);
    const double held_N = skids_[k] != 0 ? -skids_[k] * grip_N_ : std::clamp(on_tyre_N[k], -grip_N_, grip_N_);
    WheelLoad load = load_[k];
    load.torque_Nm += held_N * radius_m_[k];
    drivetrain_.set_load(side, load);
  }
}

void Board::note_stalls(const Drive& drive) {
  constexpr double kStands_mps = 0.001;
  for (std::size_t k = 0; k < 2; ++k) {
    const bool stands = std::abs(drivetrain_.speed_radps()[k]) * radius_m_[k] < kStands_mps;
    stalled_ticks_[k] = stands && !drive.open[k] && drive.duty[k] != 0 ? stalled_ticks_[k] + 1 : 0;
    wall_record_.longest_stall_ticks = std::max(wall_record_.longest_stall_ticks, stalled_ticks_[k]);
  }
}

void Board::roll(const Pair& wheels_rad) {
  encoders_.turn(wheels_rad);
  if (on_stand_) return;
  Pair rolled_m{wheels_rad[0] * radius_m_[0], wheels_rad[1] * radius_m_[1]};
  if (wall_) [[unlikely]] {
    for (std::size_t k = 0; k < 2; ++k)
      if (rolled_m[k] * skids_[k] > 0) rolled_m[k] = 0;
  }
  chassis_.advance(slip_[0].travel(rolled_m[0]), slip_[1].travel(rolled_m[1]), rolled_m[0], rolled_m[1]);
}

void Board::restart(hal::ResetCause cause) {
  clock_.restart();
  encoders_.preset({});
  motors_.coast();
  ports_.clear();
  system_.restart(cause);
  gyro_.restart();
}

}  // namespace astro::sim
