#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace astro::support::film {

/// A phone's clock and pace.
struct FilmClock {
  double fps = 30;
  double skew = 3e-5;        // robot time = that of the first frame + (1 + skew) * PTS
  double jitter_s = 0.0005;  // of the moments at which frames are taken, standard deviation
  double stamp_s = 0.0002;   // of the stamps about those moments
  double lost = 0.004;       // part of the frames that are missing
  std::uint64_t seed = 1;
};

/// A piece that somebody cut out of a film, by its stamps. Editors close the gap.
struct Cut {
  double from_s, to_s;
  bool closed = true;
};

struct FrameTime {
  double robot_s;  // the middle of row 0's exposure
  double pts_s;    // whole microseconds; 0 for the first frame
};

/// Frames from `begin_s` to `end_s` by the robot's clock. The same clock gives the same frames.
std::vector<FrameTime> frame_times(const FilmClock& clock, double begin_s, double end_s,
                                   const std::optional<Cut>& cut = {});

}  // namespace astro::support::film
