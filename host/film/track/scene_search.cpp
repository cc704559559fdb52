#include "host/film/track/scene_search.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/error.hpp"
#include "host/film/camera/film_poses.hpp"
#include "host/film/picture/how_to_film.hpp"

namespace astro::film {
namespace {

constexpr std::size_t kMostPictures = 700;

std::vector<TagCorners> corners_of(const std::vector<SeenFloorTag>& floor) {
  std::vector<TagCorners> all;
  for (const SeenFloorTag& tag : floor) all.push_back(tag.corners);
  return all;
}

/// How much has changed up to each picture, as a measure of new information: pictures of a robot at rest show
/// little that is new.
std::vector<double> happened(const std::vector<FilmPose>& poses) {
  constexpr double kStep_m = 0.05, kTurn_rad = 0.1, kRest_s = 1;
  std::vector<double> sums{0};
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Pose2 &a = poses[i - 1].pose, &b = poses[i].pose;
    sums.push_back(sums.back() + std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / kStep_m +
                   std::abs(b.theta_rad - a.theta_rad) / kTurn_rad +
                   (poses[i].time_s - poses[i - 1].time_s) / kRest_s);
  }
  return sums;
}

const RobotTagSeen& sighting_of(const std::vector<RobotTagSeen>& seen, const FilmPose& pose) {
  return *std::lower_bound(seen.begin(), seen.end(), pose.pts_s,
                           [](const RobotTagSeen& one, double pts_s) { return one.pts_s < pts_s; });
}

std::vector<RobotSighting> spread(const std::vector<FilmPose>& poses, const std::vector<RobotTagSeen>& seen) {
  std::vector<RobotSighting> chosen;
  if (poses.empty()) return chosen;
  const std::vector<double> sums = happened(poses);
  const double step = sums.back() / static_cast<double>(kMostPictures);
  double next = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (sums[i] < next) continue;
    next = std::max(next + step, sums[i] - step);
    chosen.push_back({sighting_of(seen, poses[i]).corners, poses[i].pose, poses[i].velocity});
  }
  return chosen;
}

}  // namespace

Figures figures_with_errors(const FilmFigures& given) {
  constexpr double kRuler_m = 4e-4, kHeight_m = 2e-3, kTape_m = 2e-3;
  constexpr double kFloorSide_m = 0.16, kRobotSide_m = 0.12, kRobotHeight_m = 0.12;
  const double unknown = given.as_usual ? 0.05 : 0.3, unknown_height_m = given.as_usual ? 0.06 : 0.3;
  const auto side = [&](const std::optional<double>& value, double printed) {
    return value ? Measured{*value, kRuler_m} : Measured{printed, unknown * printed};
  };
  Figures figures{side(given.floor_side_m, kFloorSide_m), side(given.robot_side_m, kRobotSide_m),
                  given.robot_height_m ? Measured{*given.robot_height_m, kHeight_m}
                                       : Measured{kRobotHeight_m, unknown_height_m}};
  for (const FilmFigures::Length& tape : given.tapes)
    figures.tapes.push_back({tape.from, tape.to, {tape.length_m, kTape_m}});
  return figures;
}

SceneFit find_scene(const FilmInfo& info, const std::vector<SeenFloorTag>& floor,
                    const std::vector<RobotTagSeen>& robot, const FilmFigures& given) {
  const Figures figures = figures_with_errors(given);
  auto start = floor_start(floor, info.width, info.height, figures.floor_side_m.value);
  if (!start)
    throw Error(std::string("the floor tags are seen as if they did not lie on one floor") +
                how_to::kFlatFloorTags);
  start->robot_side_m = figures.robot_side_m.value;
  start->robot_height_m = figures.robot_height_m.value;
  start->readout_s = given.readout_s;
  const std::vector<TagCorners> corners = corners_of(floor);
  SceneFit fit = fit_floor(*start, corners, figures);
  // The first fit shows which pictures are unusable, and how fast the robot was in each.
  for (int round = 0; round < 2; ++round)
    fit = fit_scene(fit.scene, corners, spread(film_poses(fit.scene, robot).poses, robot), figures);
  return fit;
}

}  // namespace astro::film
