#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/base/pose2.hpp"
#include "host/film/camera/camera.hpp"
#include "host/film/picture/tag_corners.hpp"

namespace astro::film {

/// A tag on the floor. Its pose is that of its centre and its x axis.
struct FloorTag {
  int id = 0;
  Pose2 pose;
};

/// All that does not change during a film. The first floor tag is the origin of the floor's frame.
struct Scene {
  Camera camera;
  int width_px = 0, height_px = 0;
  double floor_side_m = 0.16, robot_side_m = 0.12;  // of the black squares
  double floor_shift_px = 0, robot_shift_px = 0;    // by which their edges seem shifted into the black
  double robot_height_m = 0;                        // of the robot's tag above the floor
  Eigen::Vector2d robot_tilt{0, 0};                 // height gained along the tag's own x and y axes, rad
  std::vector<FloorTag> tags;
  double readout_s = 0;  // from the first row to the last; negative if the last is read first
};

/// Velocity of the robot's tag.
struct RobotVelocity {
  double x_mps = 0, y_mps = 0, omega_radps = 0;
};

/// The distance between the centres of two floor tags; nothing if the scene lacks one.
std::optional<double> distance_between(const Scene& scene, int from, int to);

/// The corners of a tag whose four edges are shifted by `shift_px` into the black. Blur, sharpening and a tone curve that is
/// not the assumed one shift all edges alike.
TagCorners with_edges_shifted(const TagCorners& corners, double shift_px);

/// Where the corners of floor tag `index` are seen.
TagCorners floor_corners(const Scene& scene, std::size_t index);

/// Where the corners of the robot's tag are seen. The camera reads its rows one after the other, so each
/// corner is seen at its own row's time. `pose` is the pose at the time of the mean of the observed rows.
///
/// `seen`  the observed corners, which give the rows
TagCorners robot_corners(const Scene& scene, const Pose2& pose, const RobotVelocity& velocity,
                         const TagCorners& seen);

/// The delay from the picture's presentation time to the moment at which a tag with these corners is seen.
double row_delay_s(const Scene& scene, const TagCorners& seen);

/// The pose for which corners at the height of the robot's tag fit best. Ignores lens blur, tilt and row
/// delays.
std::optional<Pose2> rough_pose(const Scene& scene, const TagCorners& seen);

/// A parameter of a scene that an estimator adjusts: the step of its numeric derivative, its prior, and which
/// observations depend on it.
struct SceneParameter {
  std::string name;
  double step = 0;
  double prior_mean = 0, prior_sigma = 0;  // sigma 0: there is no prior
  bool moves_floor = true, moves_robot = true;
  int only_tag = -1;  // the only floor tag that it moves, or -1
};

/// A measured value with its standard error.
struct Measured {
  double value = 0, sigma = 0;
};
struct Tape {
  int from = 0, to = 0;  // ids of floor tags
  Measured length_m;     // between their centres
};
struct Figures {
  Measured floor_side_m{0.16, 4e-4}, robot_side_m{0.12, 4e-4}, robot_height_m{0.12, 2e-3};
  std::vector<Tape> tapes = {};
  Measured focal_length_px = {};  // sigma 0: nothing is known of it
};

std::vector<SceneParameter> parameters_of(const Scene& scene, const Figures& figures);

/// The value of a parameter that has a prior; 0 for those of the camera's rotation.
double parameter_value(const Scene& scene, std::size_t index);

/// The scene with its parameters changed by `change`, in the order of parameters_of.
Scene moved(const Scene& scene, const Eigen::VectorXd& change);

/// A number computed from a scene.
using SceneValue = std::function<double(const Scene&)>;

/// The value with its standard error, propagated to first order from the covariance of the scene's
/// parameters.
Measured measured_by(const Scene& scene, const std::vector<SceneParameter>& parameters,
                     const Eigen::MatrixXd& covariance, const SceneValue& value);

}  // namespace astro::film
