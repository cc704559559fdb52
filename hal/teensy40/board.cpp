#include "hal/teensy40/board.hpp"

namespace astro::teensy40 {

Board::Board() {
  motors_.start();
  system_.start();
  encoders_.start();
  battery_.start();
  uart_.start();
  watchdog::start();
}

}  // namespace astro::teensy40
