#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "host/truth/live/stamps.hpp"
#include "host/truth/source/pose3.hpp"

namespace astro::truth {

/// One pose of the tracked body as it came from the network.
struct Sighting {
  Stamp stamp;
  Pose3 pose;
  bool tracked = true;  // as far as the tracker says
};

/// Holds what came of a body until it is taken, oldest first.
///
/// Bounds  some thousand. If nobody takes them, the newest are kept, however fast the tracker sends.
template <class T>
class Waiting {
 public:
  static constexpr std::size_t kMost = 8192;

  void push(const T& newest) {
    if (all_.size() >= kMost) all_.erase(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(kMost / 2));
    all_.push_back(newest);
  }
  std::vector<T> take() { return std::exchange(all_, {}); }
  void clear() { all_.clear(); }
  const std::vector<T>& all() const { return all_; }

 private:
  std::vector<T> all_;
};

}  // namespace astro::truth
