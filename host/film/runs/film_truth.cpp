#include "host/film/runs/film_truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "host/base/error.hpp"
#include "host/film/picture/how_to_film.hpp"
#include "host/film/runs/readout_search.hpp"

namespace astro::film {
namespace {

// A run has a likeness of 0.999 in the film that shows it. Another drive of the same programme turns at other
// times.
constexpr double kAlike = 0.97, kShown = 0.5;
constexpr double kMargin_s = 0.3;

/// Which film shows a run, and where.
struct Shown {
  std::size_t film = 0;
  Placement place;
};

/// A run's first and last moment, by the film's time.
struct RunWindow {
  double from_s = 0, to_s = 0;
};

/// A part of a run that a film does not show.
struct Lack {
  std::string what;  // "the film ends 3.0 s before it"
  const char* advice = how_to::kWholeField;
  bool left_picture = false;  // the robot drove out of the picture
};

RunWindow window_of(const recording::Run& run, double offset_s) {
  return {1e-6 * static_cast<double>(run.odometry.front().time_us) - offset_s,
          1e-6 * static_cast<double>(run.odometry.back().time_us) - offset_s};
}

/// The worst part that the film does not show for longer than a second. Nothing if there is none.
std::optional<Lack> lack_of(const RunWindow& run, const film::FilmTrack& track) {
  constexpr double kLong_s = 1;
  const film::FilmSightings& seen = track.sightings;
  if (const double late_s = seen.first_s - run.from_s; late_s > kLong_s)
    return Lack{fmt::format("the film begins {:.1f} s after it", late_s), how_to::kToTheEnd};
  if (const double early_s = run.to_s - seen.last_s; early_s > kLong_s)
    return Lack{fmt::format("the film ends {:.1f} s before it", early_s), how_to::kToTheEnd};
  const auto inside_s = [&](const film::HiddenSpan& span) {
    return std::min(span.to_s, run.to_s) - std::max(span.from_s, run.from_s);
  };
  const film::HiddenSpan* worst = nullptr;
  for (const film::HiddenSpan& span : track.hidden) {
    if (inside_s(span) <= kLong_s) continue;
    const auto rank = [&](const film::HiddenSpan& one) { return std::pair(one.left_picture, inside_s(one)); };
    if (worst == nullptr || rank(span) > rank(*worst)) worst = &span;
  }
  if (worst == nullptr) return std::nullopt;
  return Lack{fmt::format("the robot's tag is {} from {:.1f} to {:.1f} s of the film",
                          worst->left_picture ? "out of the picture" : "hidden", worst->from_s, worst->to_s),
              how_to::kWholeField, worst->left_picture};
}

std::vector<std::size_t> order_of(const experiment::RunSet& set) {
  std::vector<std::size_t> order(set.runs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return set.runs[a].info.started_at < set.runs[b].info.started_at;
  });
  return order;
}

bool is_alike(const Shown& one) { return one.place.likeness.visible >= kAlike; }
bool is_shown(const Shown& one) { return is_alike(one) && one.place.likeness.shown >= kShown; }

std::vector<Shown> shown_runs(const experiment::RunSet& set, const std::vector<NamedFilm>& films,
                              bool exchanged) {
  std::vector<MotionRates> rates;
  for (const recording::Run& run : set.runs) {
    rates.push_back(rates_of(run));
    if (exchanged)
      for (MotionRate& bin : rates.back().bins) bin.turn = -bin.turn;
  }
  const std::vector<std::size_t> order = order_of(set);
  std::vector<Shown> best(set.runs.size());
  for (std::size_t film = 0; film < films.size(); ++film) {
    const std::vector<Placement> places = place_runs(rates, rates_of(films[film].track.found.poses), order);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double likeness = places[i].likeness.all, before = best[i].place.likeness.all;
      if (likeness > before) best[i] = {film, places[i]};
      if (film > 0 && std::abs(likeness - before) < kRival) best[i].place.ambiguous = true;
    }
  }
  return best;
}

/// If no run is found, searches with the turns reversed: exchanged wheels turn the other way, and the
/// estimator then reports that.
std::vector<Shown> shown_runs(const experiment::RunSet& set, const std::vector<NamedFilm>& films) {
  std::vector<Shown> shown = shown_runs(set, films, false);
  if (std::any_of(shown.begin(), shown.end(), is_shown)) return shown;
  std::vector<Shown> mirrored = shown_runs(set, films, true);
  return std::any_of(mirrored.begin(), mirrored.end(), is_shown) ? mirrored : shown;
}

template <class Value>
void keep_at(std::vector<Value>& list, const std::vector<std::size_t>& kept) {
  if (list.empty()) return;
  std::vector<Value> result;
  for (const std::size_t i : kept) result.push_back(std::move(list[i]));
  list = std::move(result);
}

/// Takes out the runs that no film shows, and those that it shows too little of.
void leave_out_unseen(experiment::RunSet& set, std::vector<Shown>& shown, const std::vector<NamedFilm>& films,
                      FilmReport& report) {
  std::vector<std::size_t> kept;
  std::optional<Remark> reason;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const Shown& one = shown[i];
    const std::optional<Lack> lack =
        is_alike(one) ? lack_of(window_of(set.runs[i], one.place.offset_s), films[one.film].track)
                      : std::nullopt;
    if (is_shown(one) && !(lack && lack->left_picture)) {
      kept.push_back(i);
      if (lack) report.remarks.push_back({fmt::format("'{}': {}", set.names[i], lack->what) + lack->advice});
    } else if (lack) {
      report.remarks.push_back(
          {fmt::format("'{}' was left out: {}", set.names[i], lack->what) + lack->advice});
      if (!reason) reason = Remark{fmt::format("'{}': {}", set.names[i], lack->what) + lack->advice};
    } else {
      report.remarks.push_back({fmt::format("'{}' is not in the film, and was left out", set.names[i])});
    }
  }
  if (kept.empty() && reason) throw Error(*reason);
  if (kept.empty())
    throw Error(
        fmt::format("none of the {} runs is in the film: the robot there never turns and drives as its "
                    "wheels did: name the film that shows these runs",
                    set.runs.size()));
  keep_at(set.names, kept);
  keep_at(set.runs, kept);
  keep_at(set.sessions, kept);
  keep_at(shown, kept);
}

std::vector<recording::TruthSample> cut_for(const recording::Run& run,
                                            const std::vector<film::FilmPose>& poses, double offset_s) {
  const double from_s = 1e-6 * static_cast<double>(run.odometry.front().time_us) - kMargin_s;
  const double to_s = 1e-6 * static_cast<double>(run.odometry.back().time_us) + kMargin_s;
  std::vector<recording::TruthSample> samples;
  for (const film::FilmPose& pose : poses) {
    const double time_s = pose.time_s + offset_s;
    if (time_s < from_s || time_s > to_s) continue;
    samples.push_back({std::llround(1e6 * time_s), pose.pose.x_m, pose.pose.y_m, pose.pose.theta_rad});
  }
  return samples;
}

/// Changing the readout time shifts all poses of a film by some 10 ms, for which the margins of the runs
/// suffice.
void give_truth(experiment::RunSet& set, const std::vector<NamedFilm>& films, const std::vector<Shown>& shown,
                double readout_s) {
  std::vector<std::vector<film::FilmPose>> poses;
  for (const NamedFilm& film : films) {
    film::Scene scene = film.track.scene;
    if (scene.readout_s == readout_s) {
      poses.push_back(film.track.found.poses);
      continue;
    }
    scene.readout_s = readout_s;
    poses.push_back(film::film_poses(scene, film.track.sightings.robot).poses);
  }
  for (std::size_t i = 0; i < set.runs.size(); ++i) {
    recording::Run& run = set.runs[i];
    run.truth = cut_for(run, poses[shown[i].film], shown[i].place.offset_s);
    run.info.truth_source = "film";
    run.info.truth_clock = "film";
    const film::FilmTrack& track = films[shown[i].film].track;
    run.info.truth_film = track.fingerprint;
    run.info.truth_scale_sigma =
        track.figures.scale_measured() ? track.scale_sigma : std::numeric_limits<double>::infinity();
  }
}

void say_places(const experiment::RunSet& set, const std::vector<NamedFilm>& films,
                const std::vector<Shown>& shown, FilmReport& report) {
  for (std::size_t i = 0; i < set.runs.size(); ++i) {
    const RunWindow window = window_of(set.runs[i], shown[i].place.offset_s);
    report.runs.push_back(
        {set.names[i], films[shown[i].film].name, shown[i].place, window.from_s, window.to_s});
    if (shown[i].place.ambiguous)
      report.remarks.push_back({fmt::format(
          "'{}' fits at several places in what was filmed, and is taken in the order of the runs",
          set.names[i])});
  }
}

}  // namespace

FilmReport attach_films(experiment::RunSet& set, const std::vector<NamedFilm>& films,
                        std::optional<double> readout_s) {
  FilmReport report;
  for (std::size_t i = 0; i < set.runs.size(); ++i)
    if (set.runs[i].odometry.empty())
      throw Error(fmt::format("the recording '{}' holds no odometry", set.names[i]),
                  FilmedRunProblem::no_odometry, {set.names[i]});
  std::vector<Shown> shown = shown_runs(set, films);
  leave_out_unseen(set, shown, films, report);
  say_places(set, films, shown, report);
  const double usual_s = films.front().track.scene.readout_s;
  report.readout_s = readout_s.value_or(usual_s);
  if (!readout_s) {
    const auto found = find_readout(
        [&](double tried_s) {
          experiment::RunSet with = set;
          give_truth(with, films, shown, tried_s);
          return with;
        },
        usual_s);
    if (found) {
      report.readout_s = found->seconds;
      report.readout_sigma_s = found->sigma_s;
    } else {
      report.remarks.push_back(
          {fmt::format("the runs hardly show how long the camera reads a picture, and {:.0f} ms are taken",
                       1e3 * usual_s)});
    }
  }
  give_truth(set, films, shown, report.readout_s);
  report.scale_measured = true;
  for (const Shown& one : shown) {
    const film::FilmTrack& track = films[one.film].track;
    report.scale_measured = report.scale_measured && track.figures.scale_measured();
    report.scale_sigma = std::max(report.scale_sigma, track.scale_sigma);
  }
  return report;
}

}  // namespace astro::film
