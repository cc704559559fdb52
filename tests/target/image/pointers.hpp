#pragma once

#include "hal/teensy40/core/interrupts.hpp"
#include "tests/target/image/call_graph.hpp"

namespace astro::target {

/// THE list of what astrolabe-teensy40 reaches through pointers. A function whose address is taken, or that
/// calls through a pointer, fails the test of the stack until it is here.
inline const Pointers kPointers{
    {
        // Constructors of objects at file scope: there are none.
        {"astro::teensy40::(anonymous namespace)::run()", {}},
        // What main() gives to Tick::start.
        {"astro::teensy40::(anonymous namespace)::pit_interrupt()", {"main::{lambda()#1}::_FUN()"}},
    },
    {
        {"astro::teensy40::(anonymous namespace)::pit_interrupt()", teensy40::urgency::kTick},
        {"astro::teensy40::Uart::interrupt()", teensy40::urgency::kUart},
        {"astro::usb_device::UsbSerial<astro::teensy40::UsbController>::interrupt()",
         teensy40::urgency::kUsb},
    },
    {"reset", "fault_handler"}};

}  // namespace astro::target
