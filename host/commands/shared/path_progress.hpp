#pragma once

#include <cstdint>
#include <vector>

#include "host/robot/motion/paths.hpp"
#include "host/recording/run/run.hpp"

namespace astro::commands {

/// How much of a path has been driven, for a progress bar: by the way that the outer wheel goes about, so
/// that turns on the spot count too. Drift of the odometry never carries it past a segment that is not done.
class PathProgress {
 public:
  explicit PathProgress(const robot::Path& path);

  void moved_to(const recording::OdometrySample& sample);
  void segment_done(std::uint16_t tag);

  double fraction() const;
  std::size_t segments() const { return ends_m_.size(); }
  std::size_t done() const { return done_; }

 private:
  std::vector<double> ends_m_;  // way up to the end of each segment
  std::size_t done_ = 0;
  double way_m_ = 0;
  recording::OdometrySample last_;
  bool started_ = false;
};

}  // namespace astro::commands
