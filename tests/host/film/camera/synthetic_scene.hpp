#pragma once

#include <random>
#include <vector>

#include "host/film/camera/scene_fit.hpp"

/// Corners of tags as an ideal camera sees them, without pictures.
namespace astro::support {

/// A phone 2 m high that looks down by 40 degrees at a field of 2.5 m by 1.5 m with six tags around it.
film::Scene phone_scene();

/// The same phone at the ceiling, looking straight down.
film::Scene ceiling_scene();

std::vector<film::TagCorners> seen_floor(const film::Scene& scene);

/// The robot's tag at `count` places and headings all over the field, with the speed of a drive.
std::vector<film::RobotSighting> seen_robot(const film::Scene& scene, std::size_t count);

void add_noise(film::TagCorners& corners, double sigma_px, std::mt19937& random);

}  // namespace astro::support
