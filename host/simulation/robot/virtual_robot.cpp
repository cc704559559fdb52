#include "host/simulation/robot/virtual_robot.hpp"

#include <utility>

namespace astro::simulation {
namespace {
constexpr std::size_t kMinute = 60 * 60;  // samples at 60 Hz
}

VirtualRobot::VirtualRobot(const sim::Config& config, const MocapConfig& mocap)
    : board_(config), mocap_(mocap) {
  robot_.emplace(board_);
}

VirtualRobot::VirtualRobot(const sim::Config& config, const MocapConfig& mocap, const Room& room,
                           const ScannerConfig& scanner)
    : VirtualRobot(config, mocap) {
  scanner_.emplace(room, scanner);
}

void VirtualRobot::step() {
  robot_->tick();
  robot_->poll();
  if (board_.system().take_reboot_request()) return restart(hal::ResetCause::software);
  // A simulated robot cannot be flashed, so it returns from its boot loader at once.
  if (board_.system().take_bootloader_request()) return restart(hal::ResetCause::software);
  if (const auto sample = mocap_.advance(board_.clock().now_us(), board_.truth())) {
    if (seen_.size() >= 2 * kMinute) seen_.erase(seen_.begin(), seen_.begin() + kMinute);
    seen_.push_back(*sample);
  }
  if (scanner_) scanner_->advance(board_.clock().now_us(), pose_of(board_.truth()));
  board_.advance_tick();
}

void VirtualRobot::restart(hal::ResetCause cause) {
  board_.restart(cause);
  robot_.emplace(board_);
  mocap_.restart_clock();
  if (scanner_) scanner_->restart_clock();
}

std::vector<recording::TruthSample> VirtualRobot::take_truth() { return std::exchange(seen_, {}); }

}  // namespace astro::simulation
