#include "host/film/track/floor_survey.hpp"

#include <algorithm>
#include <map>

#include "host/base/order_statistics.hpp"
#include "host/film/picture/corner_refinement.hpp"
#include "host/film/picture/detector.hpp"
#include "host/film/picture/frame_stream.hpp"

namespace astro::film {
namespace {

constexpr double kMostKeyPictures = 40;
constexpr double kStill_px = 4;  // a tag that lies on the floor moves less, in a film whose camera stands

using Sightings = std::map<int, std::vector<TagCorners>>;

double distance(const TagCorners& a, const TagCorners& b) { return (center_of(a) - center_of(b)).norm(); }

void take(const GrayFrame& frame, const std::vector<DetectedTag>& tags, int robot_id, FloorSurvey& survey,
          Sightings& sightings) {
  std::map<int, int> times;
  for (const DetectedTag& tag : tags) {
    if (++times[tag.id] > 1 && tag.id == robot_id && !survey.two_robots_s) survey.two_robots_s = frame.pts_s;
    const auto fine = refine_corners(frame, tag.corners);
    const TagCorners corners = fine ? fine->corners : tag.corners;
    if (tag.id == robot_id)
      survey.robot.push_back({frame.pts_s, corners});
    else if (fine || tag.wrong_bits == 0)
      sightings[tag.id].push_back(corners);
  }
}

/// The median of each coordinate.
TagCorners typical(const std::vector<TagCorners>& all) {
  TagCorners result;
  for (std::size_t i = 0; i < 4; ++i)
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      std::vector<double> values;
      for (const TagCorners& one : all) values.push_back(one[i][axis]);
      result[i][axis] = median_of(std::move(values));
    }
  return result;
}

/// Whether a tag was seen often enough. One that was seen in few pictures only may be a misread pattern.
bool often_enough(std::size_t seen, std::size_t pictures) { return 10 * seen >= pictures; }

void sort_out(const Sightings& sightings, FloorSurvey& survey) {
  for (const auto& [id, all] : sightings) {
    if (!often_enough(all.size(), survey.pictures)) continue;
    const TagCorners middle = typical(all);
    const auto still = std::count_if(
        all.begin(), all.end(), [&](const TagCorners& one) { return distance(one, middle) < kStill_px; });
    if (2 * static_cast<std::size_t>(still) > all.size())
      survey.floor.push_back({id, middle});
    else
      survey.moving.push_back(id);
  }
}

}  // namespace

FloorSurvey survey_floor(const std::filesystem::path& film, const FilmInfo& info, int robot_id,
                         const Progress& progress) {
  FrameStream stream(film, info, FrameStream::Pictures::key_only);
  TagDetector detector;
  GrayFrame frame;
  FloorSurvey survey;
  Sightings sightings;
  std::optional<double> first_s, last_s;
  while (stream.next(frame)) {
    if (last_s && frame.pts_s - *last_s < info.duration_s / kMostKeyPictures) continue;
    last_s = frame.pts_s;
    if (!first_s) first_s = frame.pts_s;
    ++survey.pictures;
    take(frame, detector.detect(frame, whole_of(frame), 1), robot_id, survey, sightings);
    if (progress) progress(info.part(frame.pts_s - *first_s));
  }
  if (progress) progress(1);  // throws after an interrupt, which also ends the decoder
  sort_out(sightings, survey);
  return survey;
}

}  // namespace astro::film
