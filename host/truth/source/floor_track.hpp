#pragma once

#include <cstdint>
#include <optional>

#include "host/recording/run.hpp"
#include "host/truth/source/pose3.hpp"

namespace astro::truth {

/// A body's poses in space as samples on the floor: with headings that go on beyond half a turn, and marked
/// as invalid where the tracker has lost the body.
///
/// Lost  some trackers then send an impossible pose, others repeat the last one. Noise changes a measured
///       pose from frame to frame, so a pose that is equal to the one before in every digit was not measured.
class FloorTrack {
 public:
  explicit FloorTrack(UpAxis up) : up_(up) {}

  /// `tracked`: the tracker itself says whether it sees the body.
  recording::TruthSample take(std::int64_t time_us, const Pose3& pose, bool tracked = true);

 private:
  UpAxis up_;
  std::optional<Pose3> last_;
  double theta_rad_ = 0;  // of the last valid sample
};

}  // namespace astro::truth
