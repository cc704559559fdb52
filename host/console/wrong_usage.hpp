#pragma once

#include "host/base/error.hpp"

/// What was typed cannot be meant: one line, exit code 2.
namespace astro::console {

/// Options that are well-formed one by one and wrong together; found by a callback.
class WrongUsage : public Error {
 public:
  using Error::Error;
};

}  // namespace astro::console
