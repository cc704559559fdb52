#include "host/truth/floor/inspection.hpp"

#include <algorithm>

#include "host/truth/files/tracker_file.hpp"

namespace astro::truth {
namespace {

double median_period(const std::vector<TrackedPose>& samples) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < samples.size(); ++i)
    steps.push_back(samples[i].time_ns - samples[i - 1].time_ns);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return 1e-9 * static_cast<double>(*middle);
}

void count_gaps(const std::vector<TrackedPose>& samples, BodyInspection& out) {
  const TrackedPose* before = nullptr;  // the last valid sample
  bool within = false;
  for (const TrackedPose& sample : samples) {
    const double since_s = before ? 1e-9 * static_cast<double>(sample.time_ns - before->time_ns) : 0;
    const bool skipped = sample.valid && before && !within && since_s > 1.5 * out.median_period_s;
    if ((!sample.valid && !within) || skipped) ++out.gaps;
    if (sample.valid && (within || skipped)) out.longest_gap_s = std::max(out.longest_gap_s, since_s);
    within = !sample.valid;
    if (sample.valid) before = &sample;
  }
}

}  // namespace

BodyInspection inspect(BodyTrack& track) {
  BodyInspection out;
  out.name = {track.name, track.id};
  out.facts = track.facts;
  out.samples = track.samples.size();
  out.lost = mark_lost(track);
  if (!track.samples.empty())
    out.duration_s = 1e-9 * static_cast<double>(track.samples.back().time_ns - track.samples.front().time_ns);
  out.median_period_s = median_period(track.samples);
  count_gaps(track.samples, out);
  out.up = find_up_axis(track);
  out.noise = find_rest_noise(track);
  return out;
}

Inspection inspect(std::string_view text, std::string_view file) {
  constexpr std::size_t kMostBodies = 50;
  const std::vector<BodyName> bodies = bodies_in(text, file);
  Inspection out;
  out.kind = recognise(text);
  out.bodies_left_out = bodies.size() - std::min(bodies.size(), kMostBodies);
  for (std::size_t i = 0; i < bodies.size() - out.bodies_left_out; ++i) {
    BodyTrack track = read_track(text, file, bodies[i].id.empty() ? bodies[i].name : bodies[i].id);
    out.bodies.push_back(inspect(track));
  }
  return out;
}

}  // namespace astro::truth
