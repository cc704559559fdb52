#pragma once

#include "host/base/error.hpp"

namespace astro {

/// The user interrupted the program (Ctrl-C). If a robot was driving, it has confirmed that it is at rest and
/// disarmed.
class Interrupted : public Error {
 public:
  using Error::Error;
};

}  // namespace astro
