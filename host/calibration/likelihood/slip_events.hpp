#pragma once

#include <span>
#include <vector>

#include "host/calibration/likelihood/innovation.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Slip events: rotations in truth that the wheels did not see, from a castor that swings round, a cable under a
/// wheel, a hand, or a marker taken for another. Huber's loss (huber.hpp) keeps their influence on the factors
/// small; a person wants to know when they happened.
namespace astro::calibration {

struct SlipEvent {
  double time_s = 0;         // on the tracker's clock
  double since_start_s = 0;  // of the run's truth
  double turned_rad = 0;     // rotation of truth minus that of the wheels; counter-clockwise positive
  double moved_m = 0;        // displacement at the same moment
};

/// At most three per run, in order of time; none for truth without headings. Half a second of truth (eight samples if that is
/// longer) after a moment is compared with the half second before it, and dead reckoning carries both to that moment. At an
/// event the rotation between them is eight times the usual one and at least 20 mrad, and it is still there two seconds later,
/// whereas a clock error causes a rotation only during a spin. The first and last two seconds and a standing robot are not
/// examined; truth may be missing for up to a second at the event itself. `unknowns` are the fitted ones of each run.
/// Cost  linear in the samples.
std::vector<std::vector<SlipEvent>> find_slip_events(std::span<const PreparedRun> runs,
                                                     std::span<const Unknowns> unknowns);

}  // namespace astro::calibration
