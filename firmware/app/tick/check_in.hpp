#pragma once

#include <cstdint>

namespace astro {

/// The tasks that must check in before the watchdog is fed. A task that hangs stops checking in, so the
/// watchdog is not fed and resets the board, whatever the other tasks do.
class CheckIn {
 public:
  enum class Task : std::uint8_t { tick = 1, supervisor = 2, link = 4 };

  void here(Task task) { seen_ |= static_cast<std::uint8_t>(task); }

  /// True if all tasks have checked in since the last call that returned true.
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
