#pragma once

#include <Eigen/Core>
#include <vector>

#include "host/film/camera/scene.hpp"

/// Estimates the camera, the tags and the robot's poses from corners in pictures.
namespace astro::film {

/// The robot's tag in one picture.
struct RobotSighting {
  TagCorners corners;
  Pose2 pose;              // start value, and result
  RobotVelocity velocity;  // as known from neighbouring pictures
};

/// Standard errors of corner coordinates, as the scene fit assumes them.
struct CornerErrors {
  double floor_px = 0.03;  // averages over the whole film
  /// Larger than the real errors, because these are not independent: they last as long as the codec keeps a
  /// block, and are alike in all pictures with one heading. With this value 700 pictures together count about
  /// as much as one floor tag. With a smaller value the shape of one small tag would distort the camera
  /// model.
  double robot_px = 0.6;
};

struct SceneFit {
  Scene scene;
  std::vector<RobotSighting> robot;           // with their poses
  Eigen::MatrixXd covariance;                 // of the scene's parameters, in the order of parameters_of
  double floor_rms_px = 0, robot_rms_px = 0;  // of the residuals, per coordinate
  int iterations = 0;
  bool converged = false;
};

/// Maximum a posteriori estimate by Gauss-Newton with Levenberg's damping and numeric derivatives. The pose
/// blocks of the pictures are eliminated (Schur complement). A picture whose corners are off by more than
/// three standard errors is down-weighted (Huber).
///
/// `floor`  the corners of each tag of `start.tags`
/// Cost     700 pictures: about 0.1 s for each of some ten iterations.
/// Errors   none; `converged` is false if it did not settle.
SceneFit fit_scene(const Scene& start, const std::vector<TagCorners>& floor, std::vector<RobotSighting> robot,
                   const Figures& figures, const CornerErrors& errors = {});

/// Fits the floor tags alone, from a first guess (floor_start.hpp). A first fit holds the guessed focal
/// length almost fixed until the tags are in their places; a second one releases it.
SceneFit fit_floor(const Scene& start, const std::vector<TagCorners>& floor, const Figures& figures);

}  // namespace astro::film
