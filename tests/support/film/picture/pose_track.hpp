#pragma once

#include <vector>

namespace astro::support::film {

/// A pose on the floor: metres, radians counter-clockwise, not wrapped.
struct FloorPose {
  double x_m = 0, y_m = 0, theta_rad = 0;
};

/// `inner` given in the frame of `outer`, in the frame of `outer`'s parent.
FloorPose compose(const FloorPose& outer, const FloorPose& inner);

/// Where something was at each moment: samples at a fixed interval, straight lines between them. Before the first and after
/// the last it stands.
class PoseTrack {
 public:
  PoseTrack(double begin_s, double interval_s, std::vector<FloorPose> poses);

  /// Something that never moves.
  static PoseTrack standing(const FloorPose& pose) { return {0, 1, {pose}}; }

  FloorPose at(double time_s) const;
  double begin_s() const { return begin_s_; }
  double end_s() const { return begin_s_ + interval_s_ * static_cast<double>(poses_.size() - 1); }

 private:
  double begin_s_, interval_s_;
  std::vector<FloorPose> poses_;
};

}  // namespace astro::support::film
