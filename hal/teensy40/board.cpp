#include "hal/teensy40/board.hpp"

namespace astro::teensy40 {

Board::Board() {
  motors_.start();
  system_.start();
  encoders_.start();
  battery_.start();
  i2c_.start();
  uart_.start();
  usb_.start(system_.unique_id());
  watchdog::start();
}

}  // namespace astro::teensy40
