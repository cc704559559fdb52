#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "host/film/camera/scene.hpp"

/// Whether what a person has measured agrees with the film and with all else that they measured.
namespace astro::film {

enum class FigureKind { floor_side, robot_side, robot_height, tape };

struct FigureCheck {
  FigureKind kind = FigureKind::floor_side;
  std::size_t tape = 0;  // number in Figures::tapes
  Measured measured;
  Measured found;      // with this figure and all others
  Measured by_others;  // without this figure; sigma infinite if nothing else shows it

  /// By how many standard errors the figure misses what all else says; 0 if nothing else says anything.
  double off() const;
};

/// Floor side, robot side, robot height, and the tapes between tags of the scene. `covariance`: of the scene's parameters, found with these
/// figures. To first order: of a figure that is far off only that something is wrong is sure, not by how much.
std::vector<FigureCheck> check_figures(const Scene& scene, const Figures& figures,
                                       const Eigen::MatrixXd& covariance);

}  // namespace astro::film
