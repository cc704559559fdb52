#pragma once

#include "hal/interface/board.hpp"
#include "hal/rp2040/battery.hpp"
#include "hal/rp2040/clock.hpp"
#include "hal/rp2040/encoders.hpp"
#include "hal/rp2040/flash.hpp"
#include "hal/rp2040/motors.hpp"
#include "hal/rp2040/ports.hpp"
#include "hal/rp2040/system.hpp"
#include "hal/rp2040/tick.hpp"

/// The Raspberry Pi Pico as a board. Boot has set clocks, memories and vectors; the constructor starts the rest, motors
/// first, and the watchdog last: from then on the main loop feeds it.
///
///   Board board;
///   Robot<Board> robot(board);
///   Tick::start([] { ... robot.tick(); });
///   while (true) robot.poll();
///
/// A program has one of them.
namespace astro::rp2040 {

class Board {
 public:
  Board();
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;

  Clock& clock() { return clock_; }
  Encoders& encoders() { return encoders_; }
  Motors& motors() { return motors_; }
  Battery& battery() { return battery_; }
  Ports& ports() { return ports_; }
  Flash& flash() { return flash_; }
  System& system() { return system_; }
  TickHold hold_tick() { return {}; }

 private:
  Clock clock_;
  Motors motors_;
  Encoders encoders_;
  Battery battery_;
  Flash flash_;
  Uart uart_;
  UsbSerial usb_;
  System system_{usb_};
  Ports ports_{usb_, uart_};
};

static_assert(hal::Board<Board>, "this port no longer satisfies hal/interface");

}  // namespace astro::rp2040
