#pragma once

#include "host/base/error.hpp"

namespace astro::emulator {

/// The run has ended: the firmware did something that the chip would not forgive. Names the register and the
/// rule, the program counter and the time.
class Stopped : public Error {
 public:
  using Error::Error;
};

}  // namespace astro::emulator
