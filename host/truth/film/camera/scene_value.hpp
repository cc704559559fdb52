#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "host/truth/film/camera/scene.hpp"

namespace astro::film {

/// A number that follows from a scene.
using SceneValue = std::function<double(const Scene&)>;

/// The value with the standard error that the covariance of the scene's parameters gives it, to first order.
Measured measured_by(const Scene& scene, const std::vector<SceneParameter>& parameters,
                     const Eigen::MatrixXd& covariance, const SceneValue& value);

}  // namespace astro::film
