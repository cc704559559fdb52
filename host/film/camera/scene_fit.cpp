#include "host/film/camera/scene_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace astro::film {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;
using Residual = Eigen::Matrix<double, 8, 1>;
using PoseJacobian = Eigen::Matrix<double, 8, 3>;

constexpr int kMostIterations = 100;
constexpr double kHuber = 3;
constexpr double kSettled = 1e-4, kSettledPart = 1e-7;  // of the cost, which is a chi-square

Residual difference(const TagCorners& model, const TagCorners& seen) {
  Residual r;
  for (std::size_t i = 0; i < 4; ++i) r.segment<2>(static_cast<Index>(2 * i)) = model[i] - seen[i];
  return r;
}

struct Problem {
  const std::vector<TagCorners>& floor;
  const Figures& figures;
  CornerErrors errors;
};

struct State {
  Scene scene;
  std::vector<RobotSighting> robot;
};

Residual floor_residual(const Scene& scene, const Problem& problem, std::size_t tag) {
  return difference(floor_corners(scene, tag), problem.floor[tag]) / problem.errors.floor_px;
}

Residual robot_residual(const Scene& scene, const Problem& problem, const RobotSighting& one,
                        const Pose2& pose) {
  return difference(robot_corners(scene, pose, one.velocity, one.corners), one.corners) /
         problem.errors.robot_px;
}

/// Huber's weight of a picture, from the root mean square of its residuals.
double weight_of(const Residual& r) {
  const double rms = r.norm() / std::sqrt(8.0);
  return rms > kHuber ? kHuber / rms : 1;
}

double huber_cost(const Residual& r) {
  const double rms = r.norm() / std::sqrt(8.0);
  return rms > kHuber ? 8 * (2 * kHuber * rms - kHuber * kHuber) : r.squaredNorm();
}

/// Residuals of the priors, the tapes and the edge shifts, in standard errors.
VectorXd prior_residual(const Scene& scene, const Problem& problem,
                        const std::vector<SceneParameter>& parameters) {
  // One lens and one tone curve shift the edges of all tags; only focus and motion blur differ between tags.
  constexpr double kEdgesDiffer_px = 0.15;
  std::vector<double> all{(scene.robot_shift_px - scene.floor_shift_px) / kEdgesDiffer_px};
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].prior_sigma > 0)
      all.push_back((parameter_value(scene, i) - parameters[i].prior_mean) / parameters[i].prior_sigma);
  for (const Tape& tape : problem.figures.tapes) {
    if (const auto length = distance_between(scene, tape.from, tape.to))
      all.push_back((*length - tape.length_m.value) / tape.length_m.sigma);
  }
  return Eigen::Map<VectorXd>(all.data(), static_cast<Index>(all.size()));
}

double cost_of(const State& state, const Problem& problem, const std::vector<SceneParameter>& parameters) {
  double cost = prior_residual(state.scene, problem, parameters).squaredNorm();
  for (std::size_t i = 0; i < state.scene.tags.size(); ++i)
    cost += floor_residual(state.scene, problem, i).squaredNorm();
  for (const RobotSighting& one : state.robot)
    cost += huber_cost(robot_residual(state.scene, problem, one, one.pose));
  return cost;
}

Pose2 stepped(const Pose2& pose, const Eigen::Vector3d& step) {
  return {pose.x_m + step[0], pose.y_m + step[1], pose.theta_rad + step[2]};
}

/// The Jacobian of a picture's residuals with respect to its pose.
PoseJacobian by_pose_of(const Scene& scene, const Problem& problem, const RobotSighting& one) {
  constexpr double kStep = 1e-6;  // m and rad
  PoseJacobian jacobian;
  for (Index i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
    jacobian.col(i) = (robot_residual(scene, problem, one, stepped(one.pose, step)) -
                       robot_residual(scene, problem, one, stepped(one.pose, -step))) /
                      (2 * kStep);
  }
  return jacobian;
}

/// Refits the poses to a scene. The poses of a joint step are right only to first order. Their second-order
/// error, a common factor of all places, costs more than the step gains if the focal length is hardly
/// observable.
void settle_poses(State& state, const Problem& problem) {
  for (RobotSighting& one : state.robot) {
    const PoseJacobian by_pose = by_pose_of(state.scene, problem, one);
    const Residual r = robot_residual(state.scene, problem, one, one.pose);
    one.pose = stepped(one.pose, -(by_pose.transpose() * by_pose).ldlt().solve(by_pose.transpose() * r));
  }
}

/// Normal equations in which the pictures' blocks are kept separate.
struct Equations {
  MatrixXd hessian;
  VectorXd gradient;
  struct Block {
    Eigen::Matrix3d hessian;
    Eigen::Vector3d gradient;
    MatrixXd coupling;  // parameters by 3
  };
  std::vector<Block> blocks;
};

/// The scene with one parameter moved a step forward, and a step back.
struct Neighbours {
  Scene ahead, behind;
  double twice_step;
};

std::vector<Neighbours> neighbours_of(const Scene& scene, const std::vector<SceneParameter>& parameters) {
  std::vector<Neighbours> all;
  VectorXd change = VectorXd::Zero(static_cast<Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    double& entry = change[static_cast<Index>(i)];
    entry = parameters[i].step;
    Scene ahead = moved(scene, change);
    entry = -parameters[i].step;
    all.push_back({std::move(ahead), moved(scene, change), 2 * parameters[i].step});
    entry = 0;
  }
  return all;
}

void add_priors(Equations& to, const State& state, const Problem& problem,
                const std::vector<SceneParameter>& parameters, const std::vector<Neighbours>& neighbours) {
  const VectorXd r = prior_residual(state.scene, problem, parameters);
  MatrixXd jacobian(r.size(), static_cast<Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i)
    jacobian.col(static_cast<Index>(i)) = (prior_residual(neighbours[i].ahead, problem, parameters) -
                                           prior_residual(neighbours[i].behind, problem, parameters)) /
                                          neighbours[i].twice_step;
  to.hessian += jacobian.transpose() * jacobian;
  to.gradient += jacobian.transpose() * r;
}

void add_floor(Equations& to, const State& state, const Problem& problem,
               const std::vector<SceneParameter>& parameters, const std::vector<Neighbours>& neighbours) {
  for (std::size_t tag = 0; tag < state.scene.tags.size(); ++tag) {
    MatrixXd jacobian = MatrixXd::Zero(8, static_cast<Index>(parameters.size()));
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (!parameters[i].moves_floor) continue;
      if (parameters[i].only_tag >= 0 && parameters[i].only_tag != static_cast<int>(tag)) continue;
      jacobian.col(static_cast<Index>(i)) = (floor_residual(neighbours[i].ahead, problem, tag) -
                                             floor_residual(neighbours[i].behind, problem, tag)) /
                                            neighbours[i].twice_step;
    }
    to.hessian += jacobian.transpose() * jacobian;
    to.gradient += jacobian.transpose() * floor_residual(state.scene, problem, tag);
  }
}

void add_robot(Equations& to, const State& state, const Problem& problem,
               const std::vector<SceneParameter>& parameters, const std::vector<Neighbours>& neighbours) {
  const auto columns = static_cast<Index>(std::count_if(
      parameters.begin(), parameters.end(), [](const SceneParameter& p) { return p.only_tag < 0; }));
  for (const RobotSighting& one : state.robot) {
    const Residual r = robot_residual(state.scene, problem, one, one.pose);
    const PoseJacobian by_pose = by_pose_of(state.scene, problem, one);
    MatrixXd jacobian = MatrixXd::Zero(8, columns);
    for (Index i = 0; i < columns; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (!parameters[at].moves_robot) continue;
      jacobian.col(i) = (robot_residual(neighbours[at].ahead, problem, one, one.pose) -
                         robot_residual(neighbours[at].behind, problem, one, one.pose)) /
                        neighbours[at].twice_step;
    }
    const double weight = weight_of(r);
    to.hessian.topLeftCorner(columns, columns) += weight * jacobian.transpose() * jacobian;
    to.gradient.head(columns) += weight * jacobian.transpose() * r;
    to.blocks.push_back({weight * by_pose.transpose() * by_pose, weight * by_pose.transpose() * r,
                         weight * jacobian.transpose() * by_pose});
  }
}

Equations equations_of(const State& state, const Problem& problem,
                       const std::vector<SceneParameter>& parameters) {
  const auto size = static_cast<Index>(parameters.size());
  Equations to{MatrixXd::Zero(size, size), VectorXd::Zero(size), {}};
  const std::vector<Neighbours> neighbours = neighbours_of(state.scene, parameters);
  add_priors(to, state, problem, parameters, neighbours);
  add_floor(to, state, problem, parameters, neighbours);
  add_robot(to, state, problem, parameters, neighbours);
  return to;
}

/// The normal equations of the parameters alone (Schur complement), damped by `lambda` times the diagonal.
std::pair<MatrixXd, VectorXd> reduced(const Equations& equations, double lambda) {
  MatrixXd hessian = equations.hessian;
  hessian.diagonal() *= 1 + lambda;
  VectorXd gradient = equations.gradient;
  for (const Equations::Block& block : equations.blocks) {
    Eigen::Matrix3d own = block.hessian;
    own.diagonal() *= 1 + lambda;
    const Index n = block.coupling.rows();
    const MatrixXd solved = own.ldlt().solve(block.coupling.transpose());  // 3 by n
    hessian.topLeftCorner(n, n) -= block.coupling * solved;
    gradient.head(n) -= solved.transpose() * block.gradient;
  }
  return {std::move(hessian), std::move(gradient)};
}

State after_step(const State& state, const Equations& equations, double lambda) {
  const auto [hessian, gradient] = reduced(equations, lambda);
  const VectorXd change = -hessian.ldlt().solve(gradient);
  State next{moved(state.scene, change), state.robot};
  for (std::size_t i = 0; i < next.robot.size(); ++i) {
    const Equations::Block& block = equations.blocks[i];
    Eigen::Matrix3d own = block.hessian;
    own.diagonal() *= 1 + lambda;
    const Eigen::Vector3d step =
        -own.ldlt().solve(block.gradient + block.coupling.transpose() * change.head(block.coupling.rows()));
    next.robot[i].pose = stepped(next.robot[i].pose, step);
  }
  return next;
}

double rms_of(double squares, std::size_t tags) {
  return tags == 0 ? 0 : std::sqrt(squares / (8 * static_cast<double>(tags)));
}

void add_misfits(SceneFit& fit, const Problem& problem) {
  double floor = 0, robot = 0;
  for (std::size_t i = 0; i < fit.scene.tags.size(); ++i)
    floor += difference(floor_corners(fit.scene, i), problem.floor[i]).squaredNorm();
  for (const RobotSighting& one : fit.robot)
    robot +=
        difference(robot_corners(fit.scene, one.pose, one.velocity, one.corners), one.corners).squaredNorm();
  fit.floor_rms_px = rms_of(floor, fit.scene.tags.size());
  fit.robot_rms_px = rms_of(robot, fit.robot.size());
}

}  // namespace

SceneFit fit_scene(const Scene& start, const std::vector<TagCorners>& floor, std::vector<RobotSighting> robot,
                   const Figures& figures, const CornerErrors& errors) {
  const Problem problem{floor, figures, errors};
  const std::vector<SceneParameter> parameters = parameters_of(start, figures);
  State state{start, std::move(robot)};
  double cost = cost_of(state, problem, parameters), lambda = 1e-3;
  Equations equations = equations_of(state, problem, parameters);
  SceneFit fit;
  bool refused = false;  // whether the previous step was
  while (fit.iterations < kMostIterations && !fit.converged) {
    ++fit.iterations;
    State next = after_step(state, equations, lambda);
    settle_poses(next, problem);
    const double next_cost = cost_of(next, problem, parameters);
    if (!(next_cost < cost)) {  // written so that a NaN is refused, too
      fit.converged = lambda > 1e6;
      lambda *= 10;
      refused = true;
      continue;
    }
    fit.converged = cost - next_cost < kSettled + kSettledPart * cost;
    state = std::move(next);
    cost = next_cost;
    if (!std::exchange(refused, false)) lambda = std::max(lambda / 10, 1e-9);
    equations = equations_of(state, problem, parameters);
  }
  const MatrixXd information = reduced(equations, 0).first;
  fit.covariance = information.ldlt().solve(MatrixXd::Identity(information.rows(), information.cols()));
  fit.scene = std::move(state.scene);
  fit.robot = std::move(state.robot);
  add_misfits(fit, problem);
  return fit;
}

SceneFit fit_floor(const Scene& start, const std::vector<TagCorners>& floor, const Figures& figures) {
  constexpr double kAlmostFixed = 0.02;
  Figures held = figures;
  held.focal_length_px = {start.camera.f_px, kAlmostFixed * start.camera.f_px};
  return fit_scene(fit_scene(start, floor, {}, held).scene, floor, {}, figures);
}

}  // namespace astro::film
