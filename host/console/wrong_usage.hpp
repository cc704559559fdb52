#pragma once

#include "host/base/error.hpp"

/// Wrong usage of the command line: one line, exit code 2.
namespace astro::console {

/// Each option is well-formed, but their combination is wrong; thrown by a callback.
class WrongUsage : public Error {
 public:
  using Error::Error;
};

}  // namespace astro::console
