#pragma once

#include "hal/i2c/gyro.hpp"
#include "hal/interface/board.hpp"
#include "hal/teensy40/battery.hpp"
#include "hal/teensy40/clock.hpp"
#include "hal/teensy40/encoders.hpp"
#include "hal/teensy40/flash.hpp"
#include "hal/teensy40/i2c.hpp"
#include "hal/teensy40/motors.hpp"
#include "hal/teensy40/ports.hpp"
#include "hal/teensy40/system.hpp"
#include "hal/teensy40/tick.hpp"

/// The Teensy 4.0 as a board. Boot has set clocks, memories, vectors and Clock::start(); the constructor
/// starts the rest, motors first, and the watchdog last: from then on the main loop feeds it.
///
///   Board board;
///   Robot<Board> robot(board);
///   Tick::start([] { ... robot.tick(); });
///   while (true) robot.poll();
///
/// A program has one of them.
namespace astro::teensy40 {

class Board {
 public:
  Board();
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;

  Clock& clock() { return clock_; }
  Encoders& encoders() { return encoders_; }
  Motors& motors() { return motors_; }
  Battery& battery() { return battery_; }
  i2c::Gyro<I2c>& gyro() { return gyro_; }
  Ports& ports() { return ports_; }
  Flash& flash() { return flash_; }
  System& system() { return system_; }
  TickHold hold_tick() { return {}; }

 private:
  Clock clock_;
  Motors motors_;
  Encoders encoders_;
  Battery battery_;
  I2c i2c_;
  i2c::Gyro<I2c> gyro_{i2c_};  // if there is one
  Flash flash_;
  Uart uart_;
  UsbSerial usb_;
  System system_{usb_, uart_};
  Ports ports_{usb_, uart_};
};

static_assert(hal::Board<Board> && hal::HasGyro<Board>, "this port no longer satisfies hal/interface");

}  // namespace astro::teensy40
