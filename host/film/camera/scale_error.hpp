#pragma once

#include <Eigen/Core>
#include <vector>

#include "host/film/camera/scene.hpp"

namespace astro::film {

/// The standard error of the scale of the robot's path. An error in the sides of the tags, a tape, the height
/// or the focal length multiplies all distances that the robot's tag moves by one factor, which no drive can
/// show.
///
/// `pixels`      where the tag was seen; spread over the field
/// `covariance`  of the scene's parameters
double scale_error(const Scene& scene, const Figures& figures, const Eigen::MatrixXd& covariance,
                   const std::vector<Eigen::Vector2d>& pixels);

}  // namespace astro::film
