#include "hal/rp2040/board.hpp"

namespace astro::rp2040 {

Board::Board() {
  motors_.start();
  system_.start();
  encoders_.start();
  battery_.start();
  uart_.start();
  usb_.start(system_.unique_id());
  watchdog_timer::start();
}

}  // namespace astro::rp2040
