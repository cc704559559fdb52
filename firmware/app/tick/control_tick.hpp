#pragma once

#include <type_traits>
#include <utility>

#include "firmware/app/tick/tick_state.hpp"
#include "hal/interface/board.hpp"

namespace astro {

/// A value that the control tick and the main loop share. The tick interrupts the main loop anywhere, so the
/// main loop must keep the tick away while it touches the value. The compiler checks that it does:
///
///   const auto hold = board.hold_tick();
///   shared.get(hold).drive.stop();        // compiles only with the token in hand
///
/// `Hold` is the token, the guard that hal::Board::hold_tick() returns: the tick does not run while it lives.
/// `Tick` is the one class whose code runs in the interrupt and needs no token.
///
/// A temporary guard is refused: it would die at the end of the expression, and a reference to the value
/// would outlive it. What the compiler cannot see is a reference that leaves the guard's scope: do not keep
/// one.
///
/// Cost    none.
template <class T, class Hold, class Tick>
class Shared {
  static_assert(std::is_class_v<Hold> && !std::is_copy_constructible_v<Hold>,
                "the token must be a guard that nobody can copy and keep");

 public:
  template <class... Arguments>
  explicit Shared(Arguments&&... arguments) : value_(std::forward<Arguments>(arguments)...) {}
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;

  T& get(const Hold&) { return value_; }
  const T& get(const Hold&) const { return value_; }
  T& get(const Hold&&) = delete;
  const T& get(const Hold&&) const = delete;

 private:
  friend Tick;
  T& of_tick() { return value_; }

  T value_;
};

template <hal::Board Board>
class ControlTick;

/// What tick and main loop share, as the main loop of a robot on this board sees it.
template <hal::Board Board>
using SharedState = Shared<TickState<hal::HasGyro<Board>>, hal::TickHold<Board>, ControlTick<Board>>;

/// The control tick: reads the board, decides, and sets the bridges. Called at 1 kHz from the interrupt.
template <hal::Board Board>
class ControlTick {
 public:
  [[gnu::cold]] explicit ControlTick(Board& board) : board_(board), state_(ParameterSet::defaults()) {}

  void run() {
    auto& state = state_.of_tick();
    state.faults.watch(state.drive, state.clock.last_us(), state.battery_mv);
    TickInput input;
    input.now_us = board_.clock().now_us();
    input.counts = board_.encoders().read();
    input.battery_mv = board_.battery().millivolts();
    input.driver_fault = board_.motors().fault();
    input.on_time = state.clock.advance(input.now_us);
    apply(state.drive.advance(input), board_.motors());
    if constexpr (hal::HasGyro<Board>) follow_gyro(state, input.now_us);
    state.battery_mv = input.battery_mv;
    if (state.drive.take_supervised()) state.check_in.here(CheckIn::Task::supervisor);
    state.check_in.here(CheckIn::Task::tick);
  }

  SharedState<Board>& state() { return state_; }
  const SharedState<Board>& state() const { return state_; }

 private:
  /// All that a gyro can do to the motors is to open their bridges. One that is not used is not read either, and one that
  /// works is not in the ticks that are long without it: of ten that of its filter and the two in which a path is corrected. Seven
  /// ticks are enough for 140 samples a second, of rates that the sensors limit to some 60 Hz.
  void follow_gyro(TickState<true>& state, std::uint64_t now_us) {
    if (!state.gyro.in_use()) return;
    if (state.gyro.waits_in(state.drive)) return state.gyro.wait(state.drive);
    if (!state.gyro.advance(board_.gyro().read(), state.drive, now_us) || !state.drive.gives_power())
        [[likely]]
      return;
    state.drive.raise(Fault::gyro_slip);
    board_.motors().coast();
  }

  Board& board_;
  SharedState<Board> state_;
};

/// For the main loop: opens the bridges now, not with the next tick. Not inlined: it has several callers.
template <hal::Board Board>
[[gnu::noinline]] void disarm(Board& board, SharedState<Board>& state) {
  const auto hold = board.hold_tick();
  state.get(hold).drive.disarm();
  board.motors().coast();
}

}  // namespace astro
