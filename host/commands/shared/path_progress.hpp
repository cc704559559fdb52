#pragma once

#include <cstdint>
#include <vector>

#include "host/recording/run.hpp"
#include "host/robot/motion/paths.hpp"

namespace astro::commands {

/// How much of a path has been driven, for a progress bar. It measures about the distance of the outer wheel,
/// so that turns on the spot count, too. Odometry drift never moves it past the end of the segment under way.
class PathProgress {
 public:
  explicit PathProgress(const robot::Path& path);

  void moved_to(const recording::OdometrySample& sample);
  void segment_done(std::uint16_t tag);

  double fraction() const;
  std::size_t segments() const { return ends_m_.size(); }
  std::size_t done() const { return done_; }

 private:
  std::vector<double> ends_m_;  // distance up to the end of each segment
  std::size_t done_ = 0;
  double driven_m_ = 0;
  recording::OdometrySample last_;
  bool started_ = false;
};

}  // namespace astro::commands
