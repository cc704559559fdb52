#pragma once

#include <chrono>
#include <optional>

namespace astro::live {

/// Decides when a person is told of another node of the same name. A node that was killed stays visible until its lease ends,
/// after 5 s if it was one of ours (host/live/dds). A person who restarts a node after a crash need not be told of that, so a
/// node counts only once it has stayed for longer.
class TwinWatch {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kLease{8};

  /// True once each time that another node has come and stayed for kLease.
  bool note(bool is_there, Clock::time_point now) {
    if (!is_there) {
      since_.reset();
      told_ = false;
      return false;
    }
    if (!since_) since_ = now;
    if (told_ || now - *since_ < kLease) return false;
    told_ = true;
    return true;
  }

 private:
  std::optional<Clock::time_point> since_;
  bool told_ = false;
};

}  // namespace astro::live
