# What drives the peripherals; boot/, usb/ and registers/ have lists of their own.
set(TEENSY40_DRIVER_HEADERS battery.hpp board.hpp clock.hpp clock_gate.hpp cpu.hpp encoders.hpp flash.hpp flexspi.hpp
  interrupts.hpp motors.hpp pins.hpp poll.hpp ports.hpp system.hpp tick.hpp uart.hpp watchdog.hpp)
set(TEENSY40_DRIVER_SOURCES battery.cpp board.cpp clock.cpp encoders.cpp flash.cpp flexspi.cpp interrupts.cpp
  motors.cpp system.cpp tick.cpp uart.cpp watchdog.cpp)
