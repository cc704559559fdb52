#pragma once

#include <cstdint>
#include <type_traits>

#include "common/protocol/enums.hpp"
#include "common/safety/pending_faults.hpp"
#include "firmware/app/tick/drive.hpp"
#include "firmware/app/tick/gyro_heading.hpp"
#include "firmware/app/tick/tick_clock.hpp"

namespace astro {

/// Notes in the tick what the robot was doing when a fault came, until the main loop writes it to the fault
/// log (firmware/app/hosts/fault_journal.hpp).
class FaultWatch {
 public:
  /// Called once a tick, before the tick moves anything, and before faults are cleared. It notes the faults
  /// that the tick before has found, and those that the main loop has raised since. `then_us` is the time of
  /// the tick before.
  void watch(const Drive& drive, std::uint64_t then_us, std::int32_t battery_mv) {
    const std::uint32_t mask = drive.faults().mask();
    const std::uint32_t fresh = (mask & ~seen_) | at_start_;
    if (fresh != 0) [[unlikely]]
      note(fresh, drive.wheels().speeds(), then_us, battery_mv);
    seen_ = mask;
    manner_ = drive.manner();
  }

  /// The next watch() also notes this fault, which is not latched.
  void note_at_start(Fault fault) { at_start_ = bit(fault); }

  bool empty() const { return pending_.empty(); }
  /// The oldest fault that is not written yet. Precondition: not empty().
  FaultCircumstances pop() { return pending_.pop(); }

 private:
  [[gnu::noinline]] void note(std::uint32_t fresh, const WheelSpeeds& speeds, std::uint64_t then_us,
                              std::int32_t battery_mv) {
    at_start_ = 0;
    for (unsigned i = 1; i < 32; ++i) {
      if ((fresh >> i & 1U) == 0) continue;
      pending_.offer({.time_us = then_us,
                      .battery_mv = battery_mv,
                      .left_umps = speeds.left_umps,
                      .right_umps = speeds.right_umps,
                      .fault = static_cast<Fault>(i),
                      .mode = static_cast<std::uint8_t>(Drive::mode_of(manner_))});
    }
  }

  PendingFaults pending_;
  std::uint32_t seen_ = 0, at_start_ = 0;
  Drive::Manner manner_{};  // before the tick that found the fault
};

/// The tasks that must check in before the watchdog is fed. A task that hangs stops checking in, so the
/// watchdog is not fed and resets the board, whatever the other tasks do.
class CheckIn {
 public:
  enum class Task : std::uint8_t { tick = 1, supervisor = 2, link = 4 };

  void here(Task task) { seen_ |= static_cast<std::uint8_t>(task); }

  /// True if all tasks have checked in since the last call that returned true.
  bool complete() {
    constexpr std::uint8_t kAll = 7;
    if (seen_ != kAll) return false;
    seen_ = 0;
    return true;
  }

 private:
  std::uint8_t seen_ = 0;
};

/// Everything that the control tick and the main loop share. The board apart, nothing else is used by both.
template <bool kWithGyro>
struct TickState {
  using Gyro = std::conditional_t<kWithGyro, GyroHeading, NoGyro>;

  /// What a parameter set means for the tick. It takes long divisions, so it is computed outside the tick.
  struct Configuration {
    [[gnu::cold]] explicit Configuration(const ParameterSet& set)
        : drive(set), gyro(set, drive.wheels.geometry) {}
    Drive::Configuration drive;
    typename Gyro::Configuration gyro;
  };

  explicit TickState(const ParameterSet& set) : drive(set) {}

  /// Precondition: as Drive::configure has it.
  void configure(const Configuration& configuration) {
    drive.configure(configuration.drive);
    gyro.configure(configuration.gyro, drive);
  }
  /// Precondition: as Drive::set_pose has it.
  void set_pose(const Pose& pose) {
    drive.set_pose(pose);
    gyro.pose_was_set(drive);
  }

  /// First, because the tick uses it most and an instruction reaches only so far from the object's beginning.
  Drive drive;
  TickClock clock;
  CheckIn check_in;
  std::int32_t battery_mv = 0;  // as the last tick read it
  FaultWatch faults;
  [[no_unique_address]] Gyro gyro;
};

}  // namespace astro
