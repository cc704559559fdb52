#pragma once

#include <cstdint>

namespace astro {

/// Who must show signs of life before the watchdog is fed. One that hangs keeps it hungry, whatever the
/// others do.
class CheckIn {
 public:
  enum class Task : std::uint8_t { tick = 1, supervisor = 2, link = 4 };

  void here(Task task) { seen_ |= static_cast<std::uint8_t>(task); }

  /// True if all have checked in since it last was.
  bool complete() {
    constexpr std::uint8_t kAll = 7;
    if (seen_ != kAll) return false;
    seen_ = 0;
    return true;
  }

 private:
  std::uint8_t seen_ = 0;
};

}  // namespace astro
