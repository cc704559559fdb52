#pragma once

#include <Eigen/Core>
#include <vector>

#include "host/film/camera/scene.hpp"

namespace astro::film {

/// The standard error of the common factor of all distances that the robot's tag is seen to move: sides of tags, tape, height
/// and focal length all multiply the robot's whole path by one factor, which no drive can show.
///
/// `pixels`      where the tag was seen; spread over the field
/// `covariance`  of the scene's parameters
double scale_error(const Scene& scene, const Figures& figures, const Eigen::MatrixXd& covariance,
                   const std::vector<Eigen::Vector2d>& pixels);

}  // namespace astro::film
