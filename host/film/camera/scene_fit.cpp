#include "host/film/camera/scene_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "host/base/elimination.hpp"
#include "host/film/camera/frame_pose.hpp"

namespace astro::film {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;
using Picture = Elimination<Eigen::Dynamic, 3>;  // its pose is eliminated

constexpr int kMostIterations = 100;
constexpr double kHuber = 3;
constexpr double kSettled = 1e-4, kSettledPart = 1e-7;  // of the cost, which is a chi-square

struct Problem {
  const std::vector<TagCorners>& floor;
  const Figures& figures;
  CornerErrors errors;
};

struct State {
  Scene scene;
  std::vector<RobotSighting> robot;
};

CornerResidual floor_residual(const Scene& scene, const Problem& problem, std::size_t tag) {
  return residual_px(floor_corners(scene, tag), problem.floor[tag]) / problem.errors.floor_px;
}

PoseMisfit misfit_of(const Scene& scene, const RobotSighting& one) {
  return {scene, one.corners, one.velocity};
}

CornerResidual robot_residual(const Scene& scene, const Problem& problem, const RobotSighting& one) {
  return misfit_of(scene, one)(one.pose) / problem.errors.robot_px;
}

/// Huber's weight of a picture, from the root mean square of its residuals.
double weight_of(const CornerResidual& r) {
  const double rms = r.norm() / std::sqrt(8.0);
  return rms > kHuber ? kHuber / rms : 1;
}

double huber_cost(const CornerResidual& r) {
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
  for (const RobotSighting& one : state.robot) cost += huber_cost(robot_residual(state.scene, problem, one));
  return cost;
}

/// Refits the poses to a scene. The poses of a joint step are right only to first order. Their second-order
/// error, a common factor of all places, costs more than the step gains if the focal length is hardly
/// observable.
void settle_poses(State& state) {
  for (RobotSighting& one : state.robot) {
    const PoseMisfit misfit = misfit_of(state.scene, one);
    const Eigen::Matrix<double, 8, 3> by_pose = misfit.jacobian(one.pose);
    one.pose = stepped(one.pose,
                       -(by_pose.transpose() * by_pose).ldlt().solve(by_pose.transpose() * misfit(one.pose)));
  }
}

/// Normal equations in which the pictures' blocks are kept separate. The parameters that belong to one floor tag come last,
/// and no picture of the robot depends on them.
struct Equations {
  MatrixXd hessian;
  VectorXd gradient;
  struct Block {
    Eigen::Matrix3d hessian;
    Eigen::Vector3d gradient;
    Picture::Mixed coupling;

    Picture damped(double lambda) const {
      Eigen::Matrix3d own = hessian;
      own.diagonal() *= 1 + lambda;
      return {own, coupling, gradient};
    }
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
    const CornerResidual r = robot_residual(state.scene, problem, one);
    const Eigen::Matrix<double, 8, 3> by_pose =
        misfit_of(state.scene, one).jacobian(one.pose) / problem.errors.robot_px;
    MatrixXd jacobian = MatrixXd::Zero(8, columns);
    for (Index i = 0; i < columns; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (!parameters[at].moves_robot) continue;
      jacobian.col(i) = (robot_residual(neighbours[at].ahead, problem, one) -
                         robot_residual(neighbours[at].behind, problem, one)) /
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

/// The normal equations of the parameters alone.
struct Reduced {
  MatrixXd hessian;
  VectorXd gradient;
};

Reduced reduced(const Equations& equations, std::span<const Picture> pictures, double lambda) {
  Reduced out{equations.hessian, equations.gradient};
  out.hessian.diagonal() *= 1 + lambda;
  for (const Picture& picture : pictures) {
    const Index n = picture.weighted().rows();
    out.hessian.topLeftCorner(n, n) -= picture.lost_information();
    out.gradient.head(n) -= picture.lost_gradient();
  }
  return out;
}

std::vector<Picture> pictures_of(const Equations& equations, double lambda) {
  std::vector<Picture> pictures;
  for (const Equations::Block& block : equations.blocks) pictures.push_back(block.damped(lambda));
  return pictures;
}

/// The state after a step that is damped by `lambda` times the diagonal.
State after_step(const State& state, const Equations& equations, double lambda) {
  const std::vector<Picture> pictures = pictures_of(equations, lambda);
  const Reduced shared = reduced(equations, pictures, lambda);
  const VectorXd step = shared.hessian.ldlt().solve(shared.gradient);
  State next{moved(state.scene, -step), state.robot};
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    Pose2& pose = next.robot[i].pose;
    pose = stepped(pose, -pictures[i].step(step.head(pictures[i].weighted().rows())));
  }
  return next;
}

double rms_of(double squares, std::size_t tags) {
  return tags == 0 ? 0 : std::sqrt(squares / (8 * static_cast<double>(tags)));
}

void add_misfits(SceneFit& fit, const Problem& problem) {
  double floor = 0, robot = 0;
  for (std::size_t i = 0; i < fit.scene.tags.size(); ++i)
    floor += residual_px(floor_corners(fit.scene, i), problem.floor[i]).squaredNorm();
  for (const RobotSighting& one : fit.robot) robot += misfit_of(fit.scene, one)(one.pose).squaredNorm();
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
    settle_poses(next);
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
  const MatrixXd information = reduced(equations, pictures_of(equations, 0), 0).hessian;
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
