#pragma once

#include <cstdint>

#include "common/protocol/enums.hpp"
#include "firmware/app/tick/control_tick.hpp"
#include "hal/interface/board.hpp"

namespace astro {

/// The board's reset cause as the protocol has it: the same values under the same names.
constexpr protocol::ResetCause on_the_wire(hal::ResetCause cause) {
  using Board = hal::ResetCause;
  using Wire = protocol::ResetCause;
  const auto same = [](Board a, Wire b) { return static_cast<int>(a) == static_cast<int>(b); };
  static_assert(same(Board::power_on, Wire::power_on) && same(Board::software, Wire::software) &&
                same(Board::watchdog, Wire::watchdog) && same(Board::fault, Wire::fault) &&
                same(Board::pin, Wire::pin) && same(Board::unknown, Wire::unknown));
  return static_cast<Wire>(cause);
}

/// A restart of the processor that a host has asked for. Main loop only.
template <hal::Board Board>
class Restart {
 public:
  enum class Kind : std::uint8_t { none, reboot, bootloader };

  Restart(Board& board, SharedState<Board>& state) : board_(board), state_(state) {}

  /// Opens the bridges now and restarts 50 ms later, so that the answer leaves the robot first. Until then
  /// nobody can arm the robot.
  [[gnu::cold]] void schedule(Kind kind) {
    constexpr std::uint64_t kFlush_us = 50'000;
    disarm(board_, state_);
    wanted_ = kind;
    due_us_ = board_.clock().now_us() + kFlush_us;
  }
  bool scheduled() const { return wanted_ != Kind::none; }

  /// Called as often as the main loop runs. Also grants what a host asks for without the protocol, unless the
  /// robot is armed.
  void poll() {
    if (board_.system().host_wants_bootloader() && !armed()) schedule(Kind::bootloader);
    if (scheduled() && board_.clock().now_us() >= due_us_) restart();
  }

 private:
  bool armed() {
    const auto hold = board_.hold_tick();
    return state_.get(hold).drive.armed();
  }

  [[gnu::cold]] void restart() {
    disarm(board_, state_);
    const Kind kind = wanted_;
    wanted_ = Kind::none;
    if (kind == Kind::bootloader && board_.system().enter_bootloader()) return;
    if (kind == Kind::reboot) board_.system().reboot();
  }

  Board& board_;
  SharedState<Board>& state_;
  Kind wanted_ = Kind::none;
  std::uint64_t due_us_ = 0;
};

}  // namespace astro
