#pragma once

#include <optional>
#include <vector>

#include "firmware/app/robot.hpp"
#include "hal/sim/board.hpp"
#include "host/simulation/robot/virtual_mocap.hpp"
#include "host/simulation/robot/virtual_scanner.hpp"

namespace astro::simulation {

/// The firmware on the simulated board, watched by the virtual cameras. Time is virtual and passes only in
/// step().
///
/// The same configuration and the same bytes at the same times give the same bytes back.
class VirtualRobot {
 public:
  VirtualRobot(const sim::Config& config, const MocapConfig& mocap);
  /// With a laser scanner, in a room of which the robot feels nothing.
  VirtualRobot(const sim::Config& config, const MocapConfig& mocap, const Room& room,
               const ScannerConfig& scanner);

  /// Runs one millisecond: the control tick, the main loop, then the world.
  void step();

  /// Restarts the processor for this reason; the robot stays where it is.
  void restart(hal::ResetCause cause);

  sim::Board& board() { return board_; }
  const Robot<sim::Board>& robot() const { return *robot_; }
  std::uint64_t now_us() { return board_.clock().now_us(); }

  /// What the cameras saw since the last call; at least the last minute and at most the last two are kept.
  std::vector<recording::TruthSample> take_truth();

  /// The robot's laser scanner, or null.
  VirtualScanner* scanner() { return scanner_ ? &*scanner_ : nullptr; }

 private:
  sim::Board board_;
  std::optional<Robot<sim::Board>> robot_;
  VirtualMocap mocap_;
  std::optional<VirtualScanner> scanner_;
  std::vector<recording::TruthSample> seen_;
};

}  // namespace astro::simulation
