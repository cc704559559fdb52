#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "host/film/camera/scene.hpp"

/// Checks each value that a person measured against the film and all other measured values.
namespace astro::film {

enum class FigureKind { floor_side, robot_side, robot_height, tape };

struct FigureCheck {
  FigureKind kind = FigureKind::floor_side;
  std::size_t tape = 0;  // number in Figures::tapes
  Measured measured;
  Measured found;      // estimate with this figure and all others
  Measured by_others;  // estimate without this figure; sigma is infinite if nothing else determines it

  /// By how many standard errors the figure differs from the estimate without it; 0 if there is no such
  /// estimate.
  double off() const;
};

/// Checks floor side, robot side, robot height, and the tapes between tags of the scene.
///
/// `covariance`  of the scene's parameters, found with these figures
///
/// The estimates are to first order. If a figure is far off, it is certain that something is wrong, but not
/// by how much.
std::vector<FigureCheck> check_figures(const Scene& scene, const Figures& figures,
                                       const Eigen::MatrixXd& covariance);

}  // namespace astro::film
