#pragma once

#include "firmware/app/tick/shared.hpp"
#include "firmware/app/tick/tick_state.hpp"
#include "hal/interface/board.hpp"

namespace astro {

template <hal::Board Board>
class ControlTick;

/// What tick and main loop share, as the main loop of a robot on this board sees it.
template <hal::Board Board>
using SharedState = Shared<TickState, hal::TickHold<Board>, ControlTick<Board>>;

/// The control tick: reads the board, decides, and sets the bridges. Called at 1 kHz from the interrupt.
template <hal::Board Board>
class ControlTick {
 public:
  [[gnu::cold]] explicit ControlTick(Board& board) : board_(board), state_(ParameterSet::defaults()) {}

  void run() {
    TickState& state = state_.of_tick();
    state.faults.watch(state.drive, state.clock.last_us(), state.battery_mv);
    TickInput input;
    input.now_us = board_.clock().now_us();
    input.counts = board_.encoders().read();
    input.battery_mv = board_.battery().millivolts();
    input.driver_fault = board_.motors().fault();
    input.on_time = state.clock.advance(input.now_us);
    apply(state.drive.advance(input), board_.motors());
    state.battery_mv = input.battery_mv;
    if (state.drive.take_supervised()) state.check_in.here(CheckIn::Task::supervisor);
    state.check_in.here(CheckIn::Task::tick);
  }

  SharedState<Board>& state() { return state_; }
  const SharedState<Board>& state() const { return state_; }

 private:
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
