#include "host/calibration/likelihood/start_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/likelihood_problem.hpp"
#include "host/calibration/motion/tracker_noise.hpp"
#include "host/calibration/preparation/mounting.hpp"
#include "host/calibration/preparation/path_alignment.hpp"
#include "host/calibration/preparation/position_lever.hpp"
#include "host/calibration/preparation/relative_pose.hpp"
#include "host/calibration/preparation/sessions.hpp"

namespace astro::calibration {
namespace {

constexpr double kStretch_m = 1;
constexpr double kLeastTurn_rad = 1;
constexpr double kTypicalK_m = 2.6e-6;

std::vector<RelativePose> pieces_of_session(const PreparedRuns& runs, const WheelFactors& loaded,
                                            int session) {
  std::vector<RelativePose> all;
  for (std::size_t i = 0; i < runs.runs.size(); ++i) {
    if (runs.runs[i].session != session || !runs.runs[i].has_headings) continue;
    const std::vector<RelativePose> pieces = pieces_of(runs.runs[i], runs.clocks[i], loaded.b_m);
    all.insert(all.end(), pieces.begin(), pieces.end());
  }
  return all;
}

PreparedRuns only_of_session(const PreparedRuns& runs, int session) {
  PreparedRuns out;
  for (std::size_t i = 0; i < runs.runs.size(); ++i) {
    if (runs.runs[i].session != session) continue;
    out.runs.push_back(runs.runs[i]);
    out.clocks.push_back(runs.clocks[i]);
  }
  return out;
}

double mean_skew(const PreparedRuns& runs, int session) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < runs.runs.size(); ++i) {
    if (runs.runs[i].session != session) continue;
    sum += runs.clocks[i].skew;
    ++count;
  }
  return sum / count;
}

void require_forward(const RelativePoseFit& fit) {
  for (const auto& [wheel, radius] : {std::pair{"left", fit.r_left}, std::pair{"right", fit.r_right}})
    if (!(radius > 0))
      throw Error(
          fmt::format("the {} wheel comes out turning backwards: its encoder or its motor is reversed",
                      wheel),
          LikelihoodProblem::wheel_turns_backwards);
}

/// The path of the tracked body by dead reckoning over a first stretch, which is so short that wrong factors
/// hardly bend it.
std::vector<BodySample> first_stretch(std::vector<BodySample> robot, const Unknowns& u) {
  double travelled_m = 0;
  for (std::size_t i = 0; i < robot.size(); ++i) {
    const Point2 body = pose_of(robot[i]) * Point2{u[kLeverX], u[kLeverY]};
    robot[i].x_m = body.x_m;
    robot[i].y_m = body.y_m;
    if (i > 0) travelled_m += std::hypot(robot[i].x_m - robot[i - 1].x_m, robot[i].y_m - robot[i - 1].y_m);
    if (travelled_m > kStretch_m) robot.resize(i + 1);
  }
  return robot;
}

Pose2 start_pose(const PreparedRun& run, const ClockFit& clock, const WheelFactors& factors,
                 const Unknowns& u) {
  if (run.has_headings) return pose_of(run.truth.front()) * lever_of(u).inverse();
  const std::vector<BodySample> body = first_stretch(dead_reckoned(run, clock, factors), u);
  return fit_rigid(body, std::span(run.truth).first(body.size()), false).motion;
}

void place_start(const PreparedRun& run, const ClockFit& clock, const WheelFactors& factors, Unknowns& u) {
  u[kClockOffset] = clock.offset_s;
  const Pose2 start = start_pose(run, clock, factors, u);
  u.segment<3>(kStartX) << start.x_m, start.y_m, start.theta_rad;
}

}  // namespace

void require_variety(const PreparedRuns& runs) {
  double distance_m = 0, rotation_rad = 0;
  for (const PreparedRun& run : runs.runs) {
    distance_m += run.distance_m;
    rotation_rad += run.rotation_rad;
  }
  if (rotation_rad < kLeastTurn_rad)
    throw Error(
        "the robot never turned, so its wheelbase cannot be determined: drive squares, circles or spins as "
        "well",
        LikelihoodProblem::never_turned);
  if (distance_m < 0.02 * rotation_rad)
    throw Error(
        "the robot only turned on the spot, which determines the ratio of wheels and wheelbase but no size: "
        "drive lines or squares as well",
        LikelihoodProblem::only_spun);
}

std::vector<Unknowns> start_values(const PreparedRuns& runs, const WheelFactors& loaded) {
  const int sessions = session_count(runs.runs);
  std::vector<std::vector<RelativePose>> pieces;
  std::vector<std::optional<RelativePoseFit>> fits;
  std::optional<RelativePoseFit> best;
  for (int session = 0; session < sessions; ++session) {
    pieces.push_back(pieces_of_session(runs, loaded, session));
    fits.push_back(fit_relative_poses_trimmed(pieces.back(), 2, 0.02));
    if (fits.back() && (!best || fits.back()->condition < best->condition)) best = fits.back();
  }
  WheelFactors factors = loaded;
  if (best) {
    require_forward(*best);
    factors = {best->r_right, best->r_left, best->b_m, loaded.e};
  }
  std::vector<Unknowns> of_session;
  for (int session = 0; session < sessions; ++session) {
    Unknowns& shared = of_session.emplace_back(Unknowns::Zero());
    shared.head<kFactors>() << factors.c_r, factors.c_l, factors.b_m, factors.e;
    shared[kSkew] = mean_skew(runs, session);
    const auto at = static_cast<std::size_t>(session);
    std::optional<LeverArm> lever;
    if (fits[at]) lever = fits[at]->sensor;
    if (!lever && best) {
      const TurnRates rates{-best->r_left / best->b_m, best->r_right / best->b_m};
      if (const auto mounting = mounting_of(pieces[at], rates)) lever = mounting->lever;
    }
    if (!lever) lever = lever_of_positions(only_of_session(runs, session), factors);
    if (lever) shared.segment<3>(kLeverX) << lever->x_m, lever->y_m, lever->theta_rad;
  }
  std::vector<Unknowns> all;
  for (std::size_t i = 0; i < runs.runs.size(); ++i) {
    all.push_back(of_session[static_cast<std::size_t>(runs.runs[i].session)]);
    place_start(runs.runs[i], runs.clocks[i], factors, all.back());
  }
  return all;
}

NoiseModel start_noise(const PreparedRuns& runs) {
  SecondDifferences differences;
  for (const PreparedRun& run : runs.runs) differences.add(run.source->truth);
  return {kTypicalK_m, std::max(differences.sigma_xy_m(), 1e-5),
          std::max(differences.sigma_theta_rad(), 1e-5)};
}

}  // namespace astro::calibration
