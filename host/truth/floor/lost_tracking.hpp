#pragma once

#include <cstddef>

#include "host/truth/files/body_track.hpp"

/// Samples that look like measurements but are none, because the tracker had lost the body.
namespace astro::truth {

/// Samples by the reason for which they are not valid.
struct LostSamples {
  std::size_t absent = 0;  // marked in the file itself: empty cells, zeros
  std::size_t at_zero =
      0;  // exactly at the origin, while the body was elsewhere before or after; not of two samples
  std::size_t repeated = 0;  // the last pose once more to the last digit, while the body moved
  std::size_t filled = 0;    // on an exactly straight line in time: a gap that a program filled
  std::size_t jumped = 0;    // for a moment somewhere else: a marker that was taken for another
  std::size_t all() const { return absent + at_zero + repeated + filled + jumped; }
};

/// Marks them as invalid. No pose is changed, and nothing is interpolated. If a track is marked twice, it stays the same, and
/// the second call counts all as absent.
///
/// Repeated  counts only if the body moves by more than 2 cm/s or 10 degrees/s across the repetition and the pose changes by
///           more than the last digit afterwards: a body at rest may well give the same numbers twice. At the end of a track,
///           three or more repetitions after a motion count if the track has noise.
/// Filled    counts in stretches of at least 8 samples, and only if the rest of the track has noise of at least 8
///           times the last digit: a simulator's truth without noise moves in straight lines by itself.
/// Jumped    counts for a second at most, if the body is back near its place afterwards, and only if both jumps are far longer
///           than nearly all steps of the track, and than 3 cm.
/// Signs     q and -q are the same rotation, so a change of sign is no loss.
LostSamples mark_lost(BodyTrack& track);

}  // namespace astro::truth
