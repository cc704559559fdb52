#pragma once

#include <chrono>
#include <optional>

namespace astro::live {

/// Decides when a person is told of another node of the same name. One that was killed is seen for as long as its lease lasts, 5 s
/// if it was one of these (host/live/dds), and whoever starts a node again after a crash need not be told of it.
class TwinWatch {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kLease{8};

  /// True once for each time that one has come and stayed.
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
