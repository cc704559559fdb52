#include "host/experiment/film/motion_rates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace astro::experiment {
namespace {

constexpr double kTurnArm_m = 0.15;   // at which a turn counts as a speed
constexpr double kSpeedWeight = 0.5;  // the tag's speed is not the robot's while it turns
constexpr double kHalfWindow_s = 0.1, kGap_s = 0.35;

struct Place {
  double time_s, x_m, y_m, theta_rad;
};

Place between(const Place& a, const Place& b, double time_s) {
  const double span = b.time_s - a.time_s, part = span > 0 ? (time_s - a.time_s) / span : 0;
  return {time_s, a.x_m + part * (b.x_m - a.x_m), a.y_m + part * (b.y_m - a.y_m),
          a.theta_rad + part * (b.theta_rad - a.theta_rad)};
}

MotionRates rates_of_places(const std::vector<Place>& places) {
  MotionRates rates;
  if (places.size() < 2) return rates;
  rates.first_s = places.front().time_s;
  const auto count =
      static_cast<std::size_t>((places.back().time_s - places.front().time_s) / MotionRates::kBin_s) + 1;
  rates.bins.resize(count);
  std::size_t from = 1, to = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double middle_s = rates.first_s + MotionRates::kBin_s * static_cast<double>(i);
    const double begin_s = middle_s - kHalfWindow_s, end_s = middle_s + kHalfWindow_s;
    while (from + 1 < places.size() && places[from].time_s < begin_s) ++from;
    while (to + 1 < places.size() && places[to].time_s < end_s) ++to;
    if (begin_s < places.front().time_s || end_s > places.back().time_s) continue;
    bool gap = false;
    for (std::size_t k = from; k <= to; ++k) gap = gap || places[k].time_s - places[k - 1].time_s > kGap_s;
    if (gap) continue;
    const Place a = between(places[from - 1], places[from], begin_s),
                b = between(places[to - 1], places[to], end_s);
    const double dt_s = 2 * kHalfWindow_s;
    rates.bins[i] = {static_cast<float>(kTurnArm_m * (b.theta_rad - a.theta_rad) / dt_s),
                     static_cast<float>(kSpeedWeight * std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / dt_s),
                     true};
  }
  return rates;
}

}  // namespace

MotionRates rates_of(const std::vector<film::FilmPose>& poses) {
  std::vector<Place> places;
  for (const film::FilmPose& pose : poses)
    places.push_back({pose.time_s, pose.pose.x_m, pose.pose.y_m, pose.pose.theta_rad});
  return rates_of_places(places);
}

MotionRates rates_of(const recording::Run& run) {
  std::vector<Place> places;
  for (const recording::OdometrySample& sample : run.odometry) {
    const double time_s = 1e-6 * static_cast<double>(sample.time_us);
    if (!places.empty() && time_s <= places.back().time_s) continue;
    places.push_back({time_s, sample.x_m, sample.y_m, sample.theta_rad});
  }
  return rates_of_places(places);
}

Likeness likeness(const MotionRates& run, const MotionRates& film, double offset_s) {
  const double shift = (run.first_s - offset_s - film.first_s) / MotionRates::kBin_s;
  const double whole = std::floor(shift);
  const float part = static_cast<float>(shift - whole);
  const auto first = static_cast<std::ptrdiff_t>(whole), size = static_cast<std::ptrdiff_t>(film.bins.size());
  float both = 0, run_squares = 0, film_squares = 0, shown = 0;
  double sums[4] = {};  // in blocks, because a long sum of floats loses digits
  const auto add_block = [&] {
    std::size_t k = 0;
    for (float* const value : {&both, &run_squares, &film_squares, &shown})
      sums[k++] += static_cast<double>(std::exchange(*value, 0.0F));
  };
  for (std::size_t i = 0; i < run.bins.size(); ++i) {
    const MotionRate& a = run.bins[i];
    if (!a.known) continue;
    const float square = a.turn * a.turn + a.speed * a.speed;
    run_squares += square;
    if (i % 256 == 255) add_block();
    const std::ptrdiff_t at = first + static_cast<std::ptrdiff_t>(i);
    if (at < 0 || at + 1 >= size) continue;
    const MotionRate &low = film.bins[static_cast<std::size_t>(at)],
                     &high = film.bins[static_cast<std::size_t>(at + 1)];
    if (!low.known || !high.known) continue;
    const float turn = low.turn + part * (high.turn - low.turn),
                speed = low.speed + part * (high.speed - low.speed);
    film_squares += turn * turn + speed * speed;
    both += a.turn * turn + a.speed * speed;
    shown += square;
  }
  add_block();
  const auto [product, run_all, film_all, run_shown] = sums;
  if (!(run_all > 0)) return {};
  return {2 * product / (run_all + film_all),
          run_shown + film_all > 0 ? 2 * product / (run_shown + film_all) : 0, run_shown / run_all};
}

}  // namespace astro::experiment
