#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/sim/config.hpp"
#include "host/recording/run.hpp"
#include "host/robot/motion/paths.hpp"
#include "tests/support/film/film.hpp"
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

/// What a user would say about the things in a film, measured with the usual errors.
struct Stated {
  double robot_tag_m, height_m, floor_tag_m;
  std::size_t from = 0, to = 0;  // of the scene's floor tags
  double distance_m = 0;         // between their centres
  double readout_s = 0.018;      // a guess
};

/// Writes a film with its runs and its truth into a folder:
///
///   film.mp4, runs/NAME.mcap
///   truth/truth.json          robot, camera, tags, clock as they really were
///   truth/truth_frames.csv    stamp, robot time and true tag pose at the first row, and at the tag's own row
///   truth/truth_poses.csv     100 Hz, robot's clock: body and tag
///   stated.json               what a user would say
///
/// Poses are in the floor's frame. Throws what make_film does, and std::runtime_error if a file cannot be written.
void write_film_folder(const std::filesystem::path& folder, const FilmSetup& setup,
                       const FilmedDrives& drives, const sim::Config& robot, const Stated& stated);

}  // namespace astro::support::film
