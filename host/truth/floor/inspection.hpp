#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/truth/files/body_choice.hpp"
#include "host/truth/files/body_track.hpp"
#include "host/truth/floor/lost_tracking.hpp"
#include "host/truth/floor/up_axis.hpp"

/// What is in a recording, before anything is done with it.
namespace astro::truth {

/// The tracker's noise, as a body at rest shows it.
struct RestNoise {
  double rest_s = 0;             // how long the body stood, all rests together
  std::array<double, 3> sd_m{};  // per axis of the file
  double sd_rad = 0;             // of the rotation about the worst axis; 0 without rotations
};

struct BodyInspection {
  BodyName name;
  TrackFacts facts;
  std::size_t samples = 0;
  LostSamples lost;
  double duration_s = 0;       // from the first to the last sample
  double median_period_s = 0;  // between samples; 0 with fewer than two
  std::size_t gaps = 0;        // stretches without a valid sample, also at the ends
  double longest_gap_s = 0;    // between valid samples
  UpAxisEvidence up;
  std::optional<RestNoise> noise;
};

struct Inspection {
  FileKind kind = FileKind::unknown;
  std::vector<BodyInspection> bodies;
  std::size_t bodies_left_out = 0;  // beyond the first 50
};

/// Throws astro::Error if the recording cannot be read (tracker_file.hpp).
/// Cost  one reading per body.
Inspection inspect(std::string_view text, std::string_view file, std::string_view columns = {});

/// The same of a track that is already in memory; marks what is lost in it.
BodyInspection inspect(BodyTrack& track);

}  // namespace astro::truth
