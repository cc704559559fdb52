#include "host/truth/film/camera/scene_value.hpp"

#include <algorithm>
#include <cmath>

namespace astro::film {

Measured measured_by(const Scene& scene, const std::vector<SceneParameter>& parameters,
                     const Eigen::MatrixXd& covariance, const SceneValue& value) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(covariance.rows());
  Eigen::VectorXd change = gradient;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    change[at] = parameters[i].step;
    gradient[at] = (value(moved(scene, change)) - value(moved(scene, -change))) / (2 * parameters[i].step);
    change[at] = 0;
  }
  return {value(scene), std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)))};
}

}  // namespace astro::film
