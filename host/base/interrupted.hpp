#pragma once

#include "host/base/error.hpp"

namespace astro {

/// The person in front of the program wanted it to end. If a robot was driving, it has confirmed that it is at
/// rest and disarmed.
class Interrupted : public Error {
 public:
  using Error::Error;
};

}  // namespace astro
