#pragma once

#include <cstdint>

#include "common/safety/fault.hpp"

namespace astro {

/// Remembers faults until they are cleared: a mask of them, the first one and its time; and how many were
/// raised since the start.
class FaultLatch {
 public:
  /// True if this fault was not latched yet.
  bool raise(Fault fault, std::uint64_t time_us) {
    if (fault == Fault::none || (mask_ & bit(fault)) != 0) return false;
    if (mask_ == 0) {
      first_ = fault;
      first_time_us_ = time_us;
    }
    mask_ |= bit(fault);
    ++raised_;
    return true;
  }
  void clear() {
    mask_ = 0;
    first_ = Fault::none;
    first_time_us_ = 0;
  }

  bool any() const { return mask_ != 0; }
  std::uint32_t mask() const { return mask_; }
  Fault first() const { return first_; }
  std::uint64_t first_time_us() const { return first_time_us_; }
  std::uint32_t raised() const { return raised_; }

 private:
  std::uint32_t mask_ = 0;
  Fault first_ = Fault::none;
  std::uint64_t first_time_us_ = 0;
  std::uint32_t raised_ = 0;
};

}  // namespace astro
