#include "hal/teensy40/board.hpp"

namespace astro::teensy40 {

Board::Board() {
  motors_.start();
  system_.start();
  encoders_.start();
  battery_.start();
  uart_.start();
  serial_number_ = serial_number(system_.unique_id());
  usb_.start({serial_number_.data(), serial_number_.size()},
             system_.reset_cause() != hal::ResetCause::power_on);
  watchdog::start();
}

}  // namespace astro::teensy40
