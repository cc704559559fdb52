#include "host/film/track/film_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/base/error.hpp"
#include "host/base/order_statistics.hpp"
#include "host/film/picture/how_to_film.hpp"
#include "host/film/track/figure_doubts.hpp"
#include "host/film/track/film_diagnosis.hpp"

namespace astro::film {
namespace {

namespace fs = std::filesystem;

constexpr double kSmall_px = 18, kUneasy_px = 28;  // the shortest side of a tag
constexpr double kBlurred_px = 1.45;               // standard deviation of an edge; a sharp lens has 0.7
constexpr double kShakes_px = 0.7, kMoves_px = 6, kSags_px = 0.5;

std::string quoted(const fs::path& film) { return "'" + film.string() + "'"; }

[[noreturn]] void refuse_missing(const fs::path& film, const TagDiagnosis& why, const std::string& whose,
                                 const char* advice) {
  switch (why.problem) {
    case TagProblem::mirrored:
      throw Error(
          fmt::format("{}: {} is a mirror image: film with the rear camera without a mirror effect, and "
                      "print the tags as they are, not mirrored",
                      quoted(film), whose));
    case TagProblem::too_small:
      throw Error(fmt::format("{}: {} is too small in the picture: {:.0f} px, and 20 are needed",
                              quoted(film), whose, why.side_px) +
                  how_to::kNearer);
    case TagProblem::blurred:
      throw Error(fmt::format("{}: {} is blurred", quoted(film), whose) + how_to::kSharper);
    case TagProblem::none_there:
      break;
  }
  throw Error(fmt::format("{}: {} is not seen", quoted(film), whose) + advice);
}

[[noreturn]] void refuse_missing(const fs::path& film, const FilmInfo& info,
                                 const std::function<bool(int)>& wanted, const std::string& whose,
                                 const char* advice) {
  refuse_missing(film, why_no_tag(film, info, wanted), whose, advice);
}

bool drives(const FilmPose& pose) {
  constexpr double kDrives_mps = 0.03, kTurns_radps = 0.1;
  return std::hypot(pose.velocity.x_mps, pose.velocity.y_mps) > kDrives_mps ||
         std::abs(pose.velocity.omega_radps) > kTurns_radps;
}

/// The difference between the pose at `to` and that extrapolated from `from` with a speed.
struct Miss {
  double way_m, turn_rad;
};
Miss miss_of(const FilmPose& from, const FilmPose& to, const RobotVelocity& speed) {
  const double dt_s = to.time_s - from.time_s;
  return {std::hypot(to.pose.x_m - from.pose.x_m - speed.x_mps * dt_s,
                     to.pose.y_m - from.pose.y_m - speed.y_mps * dt_s),
          std::abs(std::remainder(to.pose.theta_rad - from.pose.theta_rad - speed.omega_radps * dt_s,
                                  2 * std::numbers::pi))};
}

RobotVelocity mean_speed(const FilmPose& from, const FilmPose& to) {
  const double dt_s = to.time_s - from.time_s;
  return {(to.pose.x_m - from.pose.x_m) / dt_s, (to.pose.y_m - from.pose.y_m) / dt_s,
          (to.pose.theta_rad - from.pose.theta_rad) / dt_s};
}

/// The time at which the robot jumps: its next pose differs from what both the speed before and the speed
/// after extrapolate. A single wrong picture does not count as a jump, nor does a move while the tag was
/// hidden for long.
std::optional<double> jump_in(const std::vector<FilmPose>& poses) {
  constexpr double kLeap_m = 0.04, kLeap_mps = 0.5, kLeap_rad = 0.15, kLeap_radps = 2, kHidden_s = 0.7;
  constexpr std::size_t kAround = 4;
  for (std::size_t i = kAround; i + kAround < poses.size(); ++i) {
    const FilmPose &from = poses[i - 1], &to = poses[i];
    const double dt_s = to.time_s - from.time_s;
    if (dt_s > kHidden_s) continue;
    const RobotVelocity before = mean_speed(poses[i - kAround], from),
                        after = mean_speed(to, poses[i + kAround - 1]);
    const auto leaps = [&](const FilmPose& a, const FilmPose& b) {
      const double span_s = b.time_s - a.time_s;
      const auto beyond = [&](const Miss& miss) {
        return miss.way_m > kLeap_m + kLeap_mps * span_s || miss.turn_rad > kLeap_rad + kLeap_radps * span_s;
      };
      return beyond(miss_of(a, b, before)) && beyond(miss_of(a, b, after));
    };
    if (leaps(from, to) && leaps(poses[i - 2], poses[i + 1])) return to.pts_s;
  }
  return std::nullopt;
}

bool lies_on_floor(const FloorSurvey& survey, int id) {
  return std::any_of(survey.floor.begin(), survey.floor.end(),
                     [&](const SeenFloorTag& tag) { return tag.id == id; });
}

/// The only other tag that moves, if the robot's tag never moves.
std::optional<int> moves_instead(const FloorSurvey& survey) {
  constexpr double kStill_px = 4;
  constexpr std::size_t kLeastSightings = 3;
  if (survey.robot.size() < kLeastSightings || survey.moving.size() != 1) return std::nullopt;
  const TagCorners& first = survey.robot.front().corners;
  const bool still = std::all_of(survey.robot.begin(), survey.robot.end(), [&](const FloorSurvey::Seen& one) {
    double furthest_px = 0;
    for (std::size_t i = 0; i < first.size(); ++i)
      furthest_px = std::max(furthest_px, (one.corners[i] - first[i]).norm());
    return furthest_px < kStill_px;
  });
  return still ? std::optional(survey.moving.front()) : std::nullopt;
}

[[noreturn]] void refuse_tape(const fs::path& film, const FilmInfo& info, const FloorSurvey& survey,
                              const FilmFigures& figures, const FilmFigures::Length& tape, int id) {
  const std::string pair = fmt::format("{}:{}", tape.from, tape.to);
  if (id == figures.robot_id)
    throw Error(fmt::format("{}: a distance is given to tag {}, which is the robot's", quoted(film), id),
                FilmProblem::distance_to_robot, {pair});
  std::vector<int> seen;
  for (const SeenFloorTag& tag : survey.floor) seen.push_back(tag.id);
  const std::string whose = fmt::format("floor tag {}, to which a distance is given,", id);
  const TagDiagnosis why = why_no_tag(film, info, [&](int other) { return other == id; });
  if (why.problem == TagProblem::none_there)
    throw Error(fmt::format("{}: {} is not seen, but {} are", quoted(film), whose, fmt::join(seen, ", ")),
                FilmProblem::distance_to_unseen_tag, {pair});
  refuse_missing(film, why, whose, how_to::kFloorTags);
}

}  // namespace

void refuse_survey(const fs::path& film, const FilmInfo& info, const FloorSurvey& survey,
                   const FilmFigures& figures) {
  if (survey.pictures == 0)
    throw Error(quoted(film) + " is a truncated film: no picture of it can be decoded" +
                how_to::kTakeOriginal);
  const std::string robot = fmt::format("the robot's tag (tag36h11, id {})", figures.robot_id);
  const auto is_robot = [&](int id) { return id == figures.robot_id; };
  if (survey.two_robots_s)
    throw Error(
        fmt::format("{}: {} is at two places at {:.1f} s", quoted(film), robot, *survey.two_robots_s) +
        how_to::kOneRobot);
  // Somebody may carry one other tag through the picture; several move only if the picture itself moves.
  if (survey.moving.size() >= 2 && survey.moving.size() > survey.floor.size())
    throw Error(
        fmt::format("{}: the camera was moved, or its stabilisation moves the picture: floor tags {} are not "
                    "where they were",
                    quoted(film), fmt::join(survey.moving, ", ")) +
        how_to::kFixedCamera);
  if (survey.floor.empty() && survey.robot.empty())
    refuse_missing(
        film, info, [](int) { return true; }, "the tag", how_to::kRobotTag);
  if (const auto other = moves_instead(survey))
    throw Error(fmt::format("{}: {} lies still, but id {} moves", quoted(film), robot, *other),
                FilmProblem::other_tag_moves, {std::to_string(*other)});
  if (survey.robot.empty()) {
    if (!survey.moving.empty())
      throw Error(
          fmt::format("{}: {} is not seen, but id {} moves", quoted(film), robot, survey.moving.front()),
          FilmProblem::other_tag_moves, {std::to_string(survey.moving.front())});
    refuse_missing(film, info, is_robot, robot, how_to::kRobotTag);
  }
  if (survey.floor.empty())
    refuse_missing(
        film, info, [&](int id) { return !is_robot(id); }, "a tag on the floor", how_to::kFloorTags);
  if (survey.floor.size() == 1)
    throw Error(
        fmt::format("{}: only one tag on the floor is seen, id {}", quoted(film), survey.floor.front().id) +
        how_to::kFloorTags);
  for (const FilmFigures::Length& tape : figures.tapes)
    for (const int id : {tape.from, tape.to})
      if (!lies_on_floor(survey, id)) refuse_tape(film, info, survey, figures, tape, id);
}

void refuse_sightings(const fs::path& film, const FilmInfo& info, const FloorSurvey& survey,
                      const FilmSightings& sightings) {
  constexpr double kLess_s = 1;
  const double decoded_s = sightings.last_s - sightings.first_s;
  if (info.duration_s - decoded_s > kLess_s + 0.02 * info.duration_s)
    throw Error(fmt::format("{} is a truncated film: pictures end after {:.1f} of {:.1f} s", quoted(film),
                            decoded_s, info.duration_s) +
                how_to::kTakeOriginal);
  constexpr double kLongestGap_s = 600;
  if (sightings.longest_gap_s > kLongestGap_s)
    throw Error(fmt::format("{}: its times are wrong: no pictures for {:.0f} s from {:.1f} s on",
                            quoted(film), sightings.longest_gap_s, sightings.gap_at_s) +
                how_to::kTakeOriginal);
  if (sightings.two_robots_s)
    throw Error(fmt::format("{}: the robot's tag is at two places at {:.1f} s", quoted(film),
                            *sightings.two_robots_s) +
                how_to::kOneRobot);
  // A tag that is too small to be followed was still seen in the survey, which searches more closely.
  std::vector<double> sides, widths;
  for (const auto& one : survey.robot) sides.push_back(shortest_side(one.corners));
  for (const RobotTagSeen& one : sightings.robot) {
    sides.push_back(shortest_side(one.corners));
    widths.push_back(one.edge_width_px);
  }
  if (const double side = median_of(sides); side < kSmall_px)
    throw Error(fmt::format("{}: the robot's tag is too small in the picture: {:.0f} px, and 20 are needed",
                            quoted(film), side) +
                how_to::kNearer);
  constexpr std::size_t kLeastPictures = 30;
  if (sightings.pictures < kLeastPictures)
    throw Error(
        fmt::format("{} is too short: {} pictures in {:.1f} s", quoted(film), sightings.pictures, decoded_s) +
        how_to::kToTheEnd);
  if (sightings.robot.size() < kLeastPictures)
    throw Error(fmt::format("{}: the robot's tag is seen in {} of {} pictures only", quoted(film),
                            sightings.robot.size(), sightings.pictures) +
                how_to::kWholeField);
  if (const double width = median_of(widths); width > kBlurred_px)
    throw Error(fmt::format("{}: the picture is blurred: the edges of the robot's tag are {:.1f} px wide",
                            quoted(film), 2 * width) +
                how_to::kSharper);
}

void refuse_motion(const fs::path& film, const CameraMotion& motion) {
  if (motion.shake_px > kShakes_px)
    throw Error(
        fmt::format(
            "{}: the picture shakes by {:.1f} px (the camera is not fixed, or its stabilisation moves the "
            "picture)",
            quoted(film), motion.shake_px) +
        how_to::kFixedCamera);
  if (motion.most_px > kMoves_px)
    throw Error(fmt::format("{}: the camera was moved: from about {:.1f} s on the floor tags are {:.0f} px "
                            "from where they were",
                            quoted(film), motion.most_at_s, motion.most_px) +
                how_to::kFixedCamera);
}

void refuse_track(const fs::path& film, const FilmTrack& track) {
  constexpr double kFlat_px = 3;
  const auto worst = std::max_element(
      track.floor.begin(), track.floor.end(),
      [](const FloorTagReport& a, const FloorTagReport& b) { return a.misfit_px < b.misfit_px; });
  if (worst->misfit_px > kFlat_px)
    throw Error(
        fmt::format(
            "{}: the floor tags do not lie flat on one floor, or differ in size: tag {} is {:.1f} px off",
            quoted(film), worst->id, worst->misfit_px) +
        how_to::kFlatFloorTags);
  if (track.found.poses.size() * 2 < track.sightings.robot.size() || track.found.corner_px > 1)
    throw Error(fmt::format("{}: the corners of the robot's tag fit no square on a flat floor ({:.1f} px)",
                            quoted(film), track.found.corner_px) +
                how_to::kSharper);
  if (const auto at = jump_in(track.found.poses))
    throw Error(
        fmt::format("{}: the film is cut: the robot jumps at {:.2f} s: film everything in one go, and take "
                    "the file as the phone wrote it",
                    quoted(film), *at));
}

namespace {

/// Whether the robot still drives at the end, which means that the film was stopped too early.
bool drives_at_end(const FilmTrack& track) {
  const FilmPose& last = track.found.poses.back();
  return track.sightings.last_s - last.pts_s < 0.2 && drives(last);
}

/// Whether the robot drives when its tag leaves the picture.
bool drives_out(const FilmTrack& track, const HiddenSpan& span) {
  constexpr double kJust_s = 0.2;
  return span.left_picture &&
         std::any_of(track.found.poses.begin(), track.found.poses.end(), [&](const FilmPose& pose) {
           return pose.pts_s <= span.from_s && pose.pts_s > span.from_s - kJust_s && drives(pose);
         });
}

/// Adds a remark for each span. Before the tag is first seen and after it is last seen, there is none unless
/// the robot drives out of the picture.
void say_hidden(const FilmTrack& track, std::vector<Remark>& to) {
  constexpr std::size_t kMostSaid = 5;
  std::size_t said = 0, more = 0;
  for (const HiddenSpan& span : track.hidden) {
    const bool at_end = span.from_s == track.sightings.first_s || span.to_s == track.sightings.last_s;
    if (at_end && !drives_out(track, span)) continue;
    if (++said > kMostSaid) {
      ++more;
      continue;
    }
    const std::string when = fmt::format("from {:.1f} to {:.1f} s", span.from_s, span.to_s);
    if (span.left_picture)
      to.push_back({"the robot's tag is out of the picture " + when + how_to::kWholeField});
    else
      to.push_back({"the robot's tag is hidden " + when, {}});
  }
  if (more > 0) to.push_back({fmt::format("and {} times more", more), {}});
}

bool ever_moves(const FilmTrack& track) {
  constexpr double kMoves_m = 0.02, kTurns_rad = 0.05;
  const Pose2& first = track.found.poses.front().pose;
  return std::any_of(track.found.poses.begin(), track.found.poses.end(), [&](const FilmPose& one) {
    return std::hypot(one.pose.x_m - first.x_m, one.pose.y_m - first.y_m) > kMoves_m ||
           std::abs(one.pose.theta_rad - first.theta_rad) > kTurns_rad;
  });
}

/// The relative standard error of the focal length.
double focal_length_error(const FilmTrack& track) {
  return std::sqrt(track.covariance(0, 0)) / track.scene.camera.f_px;
}

}  // namespace

std::vector<Remark> remarks_on(const FilmTrack& track, const FloorSurvey& survey) {
  constexpr double kRough_px = 0.5, kRoughScale = 2.5e-3, kRoughFocus = 0.02;
  std::vector<Remark> all;
  const FilmSightings& seen = track.sightings;
  if (!track.figures.scale_measured())
    all.push_back(
        {"nobody measured a distance, so the scale is not found: what the film shows is the ratio of the "
         "wheels "
         "and of the wheelbase to them",
         FilmProblem::no_distance});
  if (track.figures.scale_measured())
    for (const UnusualSide& side : unusual_sides(track.figures, track.scene))
      all.push_back({fmt::format(
          "nobody gave the side of the {}, which by what was given is {:.1f} mm and not {:.0f} mm: "
          "either the sheets are of another size, or what was given is wrong, and until it "
          "is measured the scale is uncertain by {:.1f} %",
          side.kind == FigureKind::floor_side ? "floor tags" : "robot's tag", 1e3 * side.found_m,
          1e3 * side.usual_m, 50 * side.part())});
  if (track.floor.size() < 4)
    all.push_back(
        {fmt::format("only {} tags on the floor are seen: four to six around the field check one another",
                     track.floor.size())});
  for (const FloorTagReport& tag : track.floor) {
    if (tag.misfit_px > kRough_px)
      all.push_back(
          {fmt::format("floor tag {} is {:.1f} px off the plane of the others", tag.id, tag.misfit_px) +
           how_to::kFlatFloorTags});
    if (tag.side_px < kSmall_px)
      all.push_back(
          {fmt::format("floor tag {} is only {:.0f} px high", tag.id, tag.side_px) + how_to::kNearer});
  }
  std::vector<double> sides;
  for (const RobotTagSeen& one : seen.robot) sides.push_back(shortest_side(one.corners));
  if (const double least = *std::min_element(sides.begin(), sides.end()); least < kUneasy_px)
    all.push_back({fmt::format("the robot's tag is only {:.0f} px high where it is farthest", least) +
                   how_to::kNearer});
  if (!ever_moves(track))
    all.push_back(
        {fmt::format("the robot's tag (id {}) does not move in the whole film", track.figures.robot_id), {}});
  const bool rough = track.figures.scale_measured() && track.scale_sigma > kRoughScale;
  if (rough && !track.figures.robot_height_m)
    all.push_back({fmt::format("nobody gave the height of the robot's tag above the floor, and the scale is "
                               "found to {:.1f} % only",
                               100 * track.scale_sigma),
                   FilmProblem::no_height});
  else if (rough && focal_length_error(track) > kRoughFocus)
    all.push_back({fmt::format(
        "the camera looks down so steeply that its focal length hardly shows, and the scale is found to "
        "{:.1f} % only: film from the side, looking down by 35 to 60 degrees, if wheels and wheelbase have "
        "to be right by more",
        100 * track.scale_sigma)});
  say_hidden(track, all);
  if (drives_at_end(track))
    all.push_back({std::string("the robot still drives when the film ends") + how_to::kToTheEnd});
  if (track.motion.most_px > kSags_px)
    all.push_back({fmt::format("the camera sagged by {:.1f} px, half of it by {:.1f} s, which was taken out",
                               track.motion.most_px, track.motion.most_at_s) +
                   how_to::kFixedCamera});
  if (seen.longest_gap_s > 0.5)
    all.push_back(
        {fmt::format("no pictures for {:.1f} s from {:.1f} s on", seen.longest_gap_s, seen.gap_at_s), {}});
  if (seen.unordered > 0)
    all.push_back(
        {fmt::format("{} pictures are not a millisecond later than the one before, and were left out",
                     seen.unordered) +
         how_to::kTakeOriginal});
  if (!seen.complaint.empty())
    all.push_back({"the decoder complains:" + seen.complaint + how_to::kTakeOriginal});
  for (const int id : survey.moving)
    all.push_back({fmt::format("tag {} moves, and is neither the robot's nor on the floor", id), {}});
  return all;
}

std::optional<Remark> departure(const fs::path& film, const FilmTrack& track) {
  constexpr double kLong_s = 1;
  for (const HiddenSpan& span : track.hidden)
    if (span.to_s - span.from_s > kLong_s && drives_out(track, span))
      return Remark{fmt::format("{}: the robot drives out of the picture at {:.1f} s, for {:.1f} s",
                                quoted(film), span.from_s, span.to_s - span.from_s) +
                    how_to::kWholeField};
  return std::nullopt;
}

}  // namespace astro::film
