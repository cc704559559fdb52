#pragma once

#include <Eigen/Core>
#include <vector>

#include "host/film/camera/scene.hpp"

/// The camera, the tags and the robot's poses from corners in pictures.
namespace astro::film {

/// The robot's tag in one picture.
struct RobotSighting {
  TagCorners corners;
  Pose2 pose;              // start value, and result
  RobotVelocity velocity;  // as known from neighbouring pictures
};

/// Standard errors of corners with which the scene is found.
struct CornerErrors {
  double floor_px = 0.03;  // averages over the whole film
  /// Larger than they are: errors of corners live for as long as the codec keeps a block, and are alike in all pictures of one
  /// heading. So that 700 pictures together count about as much as one floor tag; trusted more, the shape of one small tag
  /// would bend the camera.
  double robot_px = 0.6;
};

struct SceneFit {
  Scene scene;
  std::vector<RobotSighting> robot;           // with their poses
  Eigen::MatrixXd covariance;                 // of the scene's parameters, in the order of parameters_of
  double floor_rms_px = 0, robot_rms_px = 0;  // of what remains, per coordinate
  int iterations = 0;
  bool converged = false;
};

/// Maximum a posteriori: Gauss-Newton with Levenberg's damping, the blocks of the pictures eliminated (Schur complement),
/// numeric derivatives; a picture whose corners miss by more than three standard errors counts less (Huber).
///
/// `floor`  the corners of each tag of `start.tags`
/// Cost     700 pictures: about 0.1 s for each of some ten iterations.
/// Errors   none; `converged` is false if it did not settle.
SceneFit fit_scene(const Scene& start, const std::vector<TagCorners>& floor, std::vector<RobotSighting> robot,
                   const Figures& figures, const CornerErrors& errors = {});

/// The same from the floor tags alone, from a first guess (floor_start.hpp): with the guessed focal length held almost fixed, until
/// the tags are in their places, then without.
SceneFit fit_floor(const Scene& start, const std::vector<TagCorners>& floor, const Figures& figures);

}  // namespace astro::film
