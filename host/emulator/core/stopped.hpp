#pragma once

#include "host/base/error.hpp"

namespace astro::emulator {

/// The run has ended because the firmware did something that fails on the chip. The message names the
/// register and the rule, the program counter and the time.
class Stopped : public Error {
 public:
  using Error::Error;
};

}  // namespace astro::emulator
