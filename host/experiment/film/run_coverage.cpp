#include "host/experiment/film/run_coverage.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace astro::experiment {

RunWindow window_of(const recording::Run& run, double offset_s) {
  return {1e-6 * static_cast<double>(run.odometry.front().time_us) - offset_s,
          1e-6 * static_cast<double>(run.odometry.back().time_us) - offset_s};
}

std::optional<Lack> lack_of(const RunWindow& run, const film::FilmTrack& track) {
  constexpr double kLong_s = 1;
  const film::FilmSightings& seen = track.sightings;
  if (const double late_s = seen.first_s - run.from_s; late_s > kLong_s)
    return Lack{fmt::format("the film begins {:.1f} s after it", late_s), Help::film_to_the_end};
  if (const double early_s = run.to_s - seen.last_s; early_s > kLong_s)
    return Lack{fmt::format("the film ends {:.1f} s before it", early_s), Help::film_to_the_end};
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
              Help::film_whole_field, worst->left_picture};
}

}  // namespace astro::experiment
