#include "hal/teensy40/board.hpp"

namespace astro::teensy40 {

Board::Board() {
  motors_.start();
  system_.start();
  encoders_.start();
  battery_.start();
  i2c_.start();
  uart_.start();
  serial_number_ = serial_number(system_.unique_id());
  usb_.start({serial_number_.data(), serial_number_.size()});
  watchdog::start();
}

}  // namespace astro::teensy40
