#pragma once

#include <filesystem>
#include <optional>

#include "tests/support/film/film.hpp"
#include "tests/support/film/filmed_drives.hpp"

namespace astro::support::film {

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
