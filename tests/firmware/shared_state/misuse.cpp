// Ways to reach the state that tick and main loop share. Without MISUSE this file is correct and compiles.
// With MISUSE the compiler must refuse each marked line, for the reason in its mark (check_misuse.cmake).
#include "firmware/app/robot.hpp"
#include "hal/mock/board.hpp"

namespace {

using astro::mock::Board;
using State = astro::SharedState<Board>;

[[maybe_unused]] void main_loop(Board& board, State& state, const State& constant) {
  const auto hold = board.hold_tick();
  state.get(hold).drive.stop();
  static_cast<void>(constant.get(hold).battery_mv);
#ifdef MISUSE
  // Without the token, to change the state or only to read it.
  state.get().drive.stop();                      // refused: no matching function for call
  static_cast<void>(constant.get().battery_mv);  // refused: no matching function for call
  // With a token that is gone before the reference is used.
  state.get(board.hold_tick()).drive.stop();                      // refused: use of deleted function
  static_cast<void>(constant.get(board.hold_tick()).battery_mv);  // refused: use of deleted function
  // With something that is not the token.
  state.get(board).drive.stop();  // refused: no matching function for call
  state.get(true).drive.stop();   // refused: no matching function for call
  // By the tick's own way in, or past it.
  state.of_tick().drive.stop();  // refused: is private within this context
  state.value_.drive.stop();     // refused: is private within this context
  // By copying the state or the token.
  const auto copy = state;  // refused: use of deleted function
  const auto kept = hold;   // refused: use of deleted function
#endif
}

[[maybe_unused]] void owner(Board& board, const astro::Robot<Board>& robot) {
  const auto hold = board.hold_tick();
  static_cast<void>(robot.drive(hold).armed());
#ifdef MISUSE
  static_cast<void>(robot.drive().armed());                   // refused: no matching function for call
  static_cast<void>(robot.drive(board.hold_tick()).armed());  // refused: use of deleted function
#endif
}

#ifdef MISUSE
struct NoGuard {};
// What is shared needs a token that nobody can copy.
[[maybe_unused]] astro::Shared<int, NoGuard, NoGuard> shared;  // refused: required from here
#endif

}  // namespace
