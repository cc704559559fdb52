#pragma once

#include <string>
#include <vector>

#include "hal/sim/config.hpp"
#include "host/recording/run.hpp"
#include "host/robot/motion/paths.hpp"
#include "tests/support/film/picture/pose_track.hpp"

namespace astro::support::film {

/// A run to be driven.
struct DriveWish {
  std::string name;  // of its recording
  recording::RunInfo info;
  robot::Path path;
};

/// A square of the programme that calibrations use.
DriveWish square_wish(double side_m, Sense sense, int index = 1);
/// Any other path.
DriveWish free_wish(const std::string& name, robot::Path path);

struct FilmedDrives {
  std::vector<std::string> names;
  std::vector<recording::Run>
      runs;         // counts, odometry; /truth is the true pose of the body at 100 Hz, in the floor's frame
  PoseTrack track;  // the same at each millisecond, over all runs and the rests between them
};

/// The simulated robot with its firmware drives these runs one after the other, from where it stands each time, and stands for
/// `rest_s` before the first, between them and after the last. Everything follows from the configuration.
FilmedDrives film_drives(const sim::Config& robot, const FloorPose& start,
                         const std::vector<DriveWish>& wishes, double rest_s = 2);

}  // namespace astro::support::film
