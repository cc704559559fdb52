#pragma once

#include <cstdint>

#include "common/fixed/saturate.hpp"

namespace astro {

/// A set point that follows a target no faster than `step` a tick, and then sits on it exactly.
class Slew {
 public:
  void advance(std::int32_t target, std::int32_t step) {
    const std::int64_t gap = std::int64_t{target} - value_;
    change_ = static_cast<std::int32_t>(clamp_abs<std::int64_t>(gap, step));
    value_ += change_;
  }
  std::int32_t value() const { return value_; }
  std::int32_t change() const { return change_; }  // of the last tick
  void set(std::int32_t value) {
    value_ = value;
    change_ = 0;
  }

 private:
  std::int32_t value_ = 0;
  std::int32_t change_ = 0;
};

}  // namespace astro
