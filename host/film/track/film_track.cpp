#include "host/film/track/film_track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "host/base/error.hpp"
#include "host/film/camera/scale_error.hpp"
#include "host/film/track/figure_doubts.hpp"
#include "host/film/track/film_checks.hpp"
#include "host/film/track/film_diagnosis.hpp"
#include "host/film/track/floor_survey.hpp"
#include "host/film/track/scene_search.hpp"

namespace astro::film {
namespace {

constexpr double kSurveyPart = 0.1;  // of the work

Progress part_of(const Progress& progress, double from, double to) {
  if (!progress) return {};
  return [=](double done) { progress(from + (to - from) * done); };
}

void steady(FilmSightings& sightings, const CameraMotion& motion) {
  for (RobotTagSeen& one : sightings.robot) one.corners = motion.steadied(one.pts_s, one.corners);
}

std::vector<SeenFloorTag> on_average(const std::vector<SeenFloorTag>& floor, const CameraMotion& motion) {
  std::vector<SeenFloorTag> means = floor;
  for (std::size_t i = 0; i < means.size(); ++i) means[i].corners = motion.means[i];
  return means;
}

std::vector<FloorTagReport> report_on(const FilmTrack& track) {
  std::vector<FloorTagReport> all;
  const double looks = std::max(1.0, static_cast<double>(track.sightings.looks.size()));
  for (std::size_t i = 0; i < track.scene.tags.size(); ++i) {
    const TagCorners model = floor_corners(track.scene, i), &seen = track.motion.means[i];
    double squares = 0;
    for (std::size_t k = 0; k < 4; ++k) squares += (model[k] - seen[k]).squaredNorm();
    all.push_back({track.scene.tags[i].id, shortest_side(seen),
                   static_cast<double>(track.motion.seen[i]) / looks, std::sqrt(squares / 8)});
  }
  return all;
}

/// Whether the tag is within one side of the picture's border, so that the next picture may not show all of
/// it.
bool at_border(const RobotTagSeen& one, const FilmInfo& info) {
  const double side = longest_side(one.corners);
  const Eigen::Vector2d center = center_of(one.corners);
  return std::min({center.x(), center.y(), info.width - center.x(), info.height - center.y()}) < 1.5 * side;
}

/// All spans longer than half a second, also before the tag is first seen and after it is last seen.
std::vector<HiddenSpan> hidden_spans(const FilmSightings& seen, const FilmInfo& info) {
  constexpr double kLong_s = 0.5;
  std::vector<HiddenSpan> all;
  HiddenSpan span{seen.first_s};
  const auto end_at = [&](double to_s) {
    span.to_s = to_s;
    if (span.to_s - span.from_s > kLong_s) all.push_back(span);
  };
  for (const RobotTagSeen& one : seen.robot) {
    const bool border = at_border(one, info);
    span.left_picture = span.left_picture || border;
    end_at(one.pts_s);
    span = {one.pts_s, 0, border};
  }
  end_at(seen.last_s);
  return all;
}

double scale_sigma_of(const FilmTrack& track) {
  constexpr std::size_t kPlaces = 200;
  std::vector<Eigen::Vector2d> pixels;
  const std::vector<RobotTagSeen>& robot = track.sightings.robot;
  for (std::size_t i = 0; i < robot.size(); i += robot.size() / kPlaces + 1)
    pixels.push_back(center_of(robot[i].corners));
  return scale_error(track.scene, figures_with_errors(track.figures), track.covariance, pixels);
}

std::string fingerprint_of(const FilmSightings& sightings) {
  // FNV-1a over hundredths of pixels and whole milliseconds.
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto take = [&](double value) {
    auto rest = static_cast<std::uint64_t>(std::llround(value));
    for (int i = 0; i < 4; ++i, rest >>= 8) hash = (hash ^ (rest & 0xff)) * 0x100000001b3;
  };
  for (const RobotTagSeen& one : sightings.robot) {
    take(1e3 * one.pts_s);
    for (const Eigen::Vector2d& corner : one.corners) take(1e2 * corner.x()), take(1e2 * corner.y());
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace

FilmTrack follow_film(const std::filesystem::path& film, const FilmFigures& figures,
                      const Progress& progress) {
  FilmTrack track;
  track.figures = figures;
  track.info = read_film_info(film);
  const FloorSurvey survey =
      survey_floor(film, track.info, figures.robot_id, part_of(progress, 0, kSurveyPart));
  refuse_survey(film, track.info, survey, figures);
  track.sightings = watch_film(film, track.info, figures.robot_id, survey, part_of(progress, kSurveyPart, 1));
  refuse_sightings(film, track.info, survey, track.sightings);
  std::vector<TagCorners> start;
  for (const SeenFloorTag& tag : survey.floor) start.push_back(tag.corners);
  track.motion = camera_motion(track.sightings.looks, start);
  refuse_motion(film, track.motion);
  track.fingerprint = fingerprint_of(track.sightings);
  steady(track.sightings, track.motion);
  const std::vector<SeenFloorTag> floor = on_average(survey.floor, track.motion);
  const auto fitted = [&](const FilmFigures& with) {
    if (progress) progress(1);  // may end the work
    return find_scene(track.info, floor, track.sightings.robot, with);
  };
  SceneFit fit = fitted(figures);
  const std::optional<FigureDoubt> doubt = doubt_about_figures(figures, fit, fitted);
  if (doubt && doubt->gross) throw Error(doubt->remark.in("'" + film.string() + "': "));
  if (doubt) track.figures = doubt->figures;
  if (doubt && doubt->fit) fit = *doubt->fit;
  track.checked = given_figures(track.figures, fit);
  track.scene = std::move(fit.scene);
  track.covariance = std::move(fit.covariance);
  track.floor_rms_px = fit.floor_rms_px;
  track.found = film_poses(track.scene, track.sightings.robot);
  track.floor = report_on(track);
  track.hidden = hidden_spans(track.sightings, track.info);
  refuse_track(film, track);
  track.scale_sigma = scale_sigma_of(track) * growth_of_error(track.checked);
  if (figures.scale_measured())
    for (const UnusualSide& side : unusual_sides(figures, track.scene))
      track.scale_sigma = std::max(track.scale_sigma, side.part() / 2);
  track.remarks = remarks_on(track, survey);
  if (doubt && !doubt->remark.sentence.empty()) track.remarks.insert(track.remarks.begin(), doubt->remark);
  return track;
}

}  // namespace astro::film
