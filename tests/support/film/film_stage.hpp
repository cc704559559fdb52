#pragma once

#include "tests/support/film/film_set.hpp"

/// What the films of the set have in common: rooms, lenses, a robot that differs from its parameters.
namespace astro::support::film {

inline constexpr double kDegree = 0.017453292519943295;

/// A phone's main lens (65 degrees across) and one as wide as main lenses get (80 degrees).
Lens main_lens();
Lens wide_lens();
/// The same lens with a picture of 1280 x 720.
Lens at_720p(const Lens& lens);

/// On a shelf behind the start, 40 degrees down; at a ceiling.
Camera on_shelf();
Camera on_stairs();  // nearer and steeper, for the wide lens
Camera at_ceiling(double height_m);

/// Six tags around a field of two squares of 1 m, as an oblique or an overhead camera can see them. They lie up to `bulge_m` off
/// the plane.
std::vector<FloorTag> tags_around(bool overhead, double bulge_m = 0);

/// A robot as it is before a calibration: wheels, wheelbase and scale off by a few tenths of a per cent.
sim::Config uncalibrated_robot(std::uint64_t seed);

FilmedRobot filmed(const PoseTrack& track);

/// A case with everything but lens and camera: the robot at the origin, heading away, drives `wishes`.
FilmCase staged(const std::string& name, const std::string& what, std::uint64_t seed,
                const std::vector<DriveWish>& wishes, std::vector<FloorTag> floor);

/// Much noise, as in a dim room.
void make_noisy(FilmSetup& setup);

}  // namespace astro::support::film
