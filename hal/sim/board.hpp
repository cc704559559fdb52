#pragma once

#include <optional>

#include "hal/interface/board.hpp"
#include "hal/sim/battery.hpp"
#include "hal/sim/chassis.hpp"
#include "hal/sim/config.hpp"
#include "hal/sim/drivetrain.hpp"
#include "hal/sim/encoder.hpp"
#include "hal/sim/flash.hpp"
#include "hal/sim/gyro.hpp"
#include "hal/sim/motors.hpp"
#include "hal/sim/ports.hpp"
#include "hal/sim/restart_slip.hpp"
#include "hal/sim/slip.hpp"
#include "hal/sim/system.hpp"
#include "hal/sim/wall.hpp"

/// The simulated robot as a board. Its owner runs it: after each control tick of the firmware, advance_tick()
/// moves the world on by 1 ms. Everything follows from the configuration, the seed and the calls, so the same
/// calls give the same bytes.
///
/// Cost    advance_tick() about 100 ns while driving, 40 ns at rest; no heap after construction.
namespace astro::sim {

/// What a robot in a world with a wall has done since it was made.
struct WallRecord {
  double hardest_N = 0;  // the most that it pressed on the wall
  int longest_stall_ticks =
      0;  // the longest time that a wheel stood, slower than 1 mm/s, with voltage on its motor
};

class Board {
 public:
  static constexpr std::uint64_t kTick_us = 1000;

  explicit Board(const Config& config);
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;

  // What the firmware sees (hal::Board).
  Clock& clock() { return clock_; }
  Encoders& encoders() { return encoders_; }
  Motors& motors() { return motors_; }
  Battery& battery() { return battery_; }
  Gyro& gyro() { return gyro_; }
  Ports& ports() { return ports_; }
  Flash& flash() { return flash_; }
  System& system() { return system_; }

  /// Nothing interrupts a simulated main loop: the owner calls the tick.
  class [[nodiscard]] Hold {
   public:
    Hold() = default;
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    ~Hold() {}  // NOLINT(modernize-use-equals-default): a guard that is only declared must not warn
  };
  Hold hold_tick() { return {}; }

  // What only the owner sees.

  /// Moves the world on by one control tick.
  void advance_tick();

  /// The processor restarts: clock, counts, queues and bridges are as at power-on; flash and world stay as
  /// they are.
  void restart(hal::ResetCause cause);

  /// Virtual time since construction; a restart does not reset it.
  std::uint64_t world_us() const { return world_us_; }

  /// The robot's true pose, at the same instant as the encoder counts; starts at the origin.
  Pose truth() const { return chassis_.pose(); }
  void place(const Pose& pose) {
    chassis_.place(pose);
    gyro_.place(pose.theta_rad);
  }
  /// Turns the robot on the spot, which no wheel notices: a kick.
  void kick(double turn_rad) { chassis_.jump(turn_rad); }

  const Drivetrain& drivetrain() const { return drivetrain_; }
  void set_load(Side side, const WheelLoad& load) {
    load_[at(side)] = load;
    drivetrain_.set_load(side, load);
  }

  /// The wall, if there is one, and how hard the robot pressed on it in the last tick.
  const std::optional<Wall>& wall() const { return wall_; }
  double pressing_N() const { return pressing_N_; }
  const WallRecord& wall_record() const { return wall_record_; }

 private:
  void lean_on_wall();
  void note_stalls(const Drive& drive);
  void roll(const Pair& wheels_rad);

  Pair radius_m_;
  bool on_stand_;
  Clock clock_;
  Encoders encoders_;
  Motors motors_;
  Battery battery_;
  Ports ports_;
  Flash flash_;
  System system_;
  Drivetrain drivetrain_;
  std::array<Slip, 2> slip_;
  RestartSlip restart_slip_;
  Chassis chassis_;
  Gyro gyro_;
  std::uint64_t world_us_ = 0;
  std::optional<Wall> wall_;
  double wheelbase_m_, grip_N_;
  std::array<WheelLoad, 2> load_{};  // without the wall's part
  Pair skids_{};  // sign of the wheel's rotation that moves nothing, because its tyre skids
  double pressing_N_ = 0;
  WallRecord wall_record_;
  std::array<int, 2> stalled_ticks_{};
};

static_assert(hal::Board<Board> && hal::HasGyro<Board>, "this port no longer satisfies hal/interface");

}  // namespace astro::sim
