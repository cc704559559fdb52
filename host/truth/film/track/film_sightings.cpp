#include "host/truth/film/track/film_sightings.hpp"

#include <algorithm>

#include "host/truth/film/track/floor_watch.hpp"
#include "host/truth/film/track/robot_tracker.hpp"
#include "host/truth/film/video/frame_stream.hpp"

namespace astro::film {
namespace {

constexpr double kLeastGap_s = 0.9e-3;  // of a thousand pictures a second; nearer ones have wrong times

/// Notes the picture's time; false if it is not later than the one before.
bool note_time(FilmSightings& all, double pts_s) {
  if (all.pictures == 0) all.first_s = all.last_s = pts_s;
  const double gap_s = pts_s - all.last_s;
  if (++all.pictures > 1 && gap_s < kLeastGap_s) {
    ++all.unordered;
    return false;
  }
  if (gap_s > all.longest_gap_s) {
    all.longest_gap_s = gap_s;
    all.gap_at_s = all.last_s;
  }
  all.last_s = pts_s;
  return true;
}

}  // namespace

FilmSightings watch_film(const std::filesystem::path& film, const FilmInfo& info, int robot_id,
                         const FloorSurvey& survey, const Progress& progress) {
  FrameStream stream(film, info, FrameStream::Pictures::all);
  RobotTracker tracker(robot_id);
  if (!survey.robot.empty()) tracker.expect(survey.robot.front().corners);
  FloorWatch watch(survey.floor);
  FilmSightings all;
  all.two_robots_s = survey.two_robots_s;
  GrayFrame frame;
  while (stream.next(frame)) {
    if (!note_time(all, frame.pts_s)) continue;
    watch.take(frame);
    if (const auto tag = tracker.find(frame))
      all.robot.push_back({frame.pts_s, tag->corners, tag->edge_width_px});
    if (tracker.twice() && !all.two_robots_s) all.two_robots_s = frame.pts_s;
    if (progress) progress(info.part(frame.pts_s - all.first_s));
  }
  if (progress) progress(1);  // an interrupt ends the decoder as well, which looks like the end of the film
  all.looks = watch.looks();
  all.complaint = stream.complaint();
  return all;
}

}  // namespace astro::film
