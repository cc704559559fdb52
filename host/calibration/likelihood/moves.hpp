#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "host/calibration/likelihood/matrix3.hpp"
#include "host/calibration/likelihood/unknowns.hpp"
#include "host/calibration/preparation/prepared_run.hpp"

/// What the wheels alone say of a drive, given its unknowns: the arcs between its truth samples. Several passes of the filter
/// share it.
namespace astro::calibration {

/// The unknowns by which the wheels' path differs, in the order of Move::by.
inline constexpr std::array kMoveUnknowns{kCRight, kCLeft, kB, kE, kSkew, kClockOffset};

/// An arc of the robot. Its frame has the x axis along the chord, so the heading in the middle of the arc turns it into the
/// tracker's frame.
struct Move {
  double chord_m = 0;  // negative backwards
  double turn_rad = 0;
  double half_cosine = 1, half_sine = 0;  // of half the turn
  Symmetric3 slip_per_K;                  // covariance of the pose's change that slip causes, for K = 1 m
  /// Derivatives of the pose's change by each of kMoveUnknowns.
  std::array<Vector3, kMoveUnknowns.size()> by{};
};

class Moves {
 public:
  /// Of arcs that last kLongestStep_s at most. The run must outlive this.
  Moves(const PreparedRun& run, const Unknowns& unknowns, double kappa0 = kUsualKappa0);

  const PreparedRun& run() const { return *run_; }
  const Unknowns& unknowns() const { return unknowns_; }
  /// The moves that end at a truth sample and begin at the one before; none where the wheels stood.
  std::span<const Move> before(std::size_t sample) const {
    const std::size_t begin = sample == 0 ? 0 : ends_[sample - 1];
    return std::span(moves_).subspan(begin, ends_[sample] - begin);
  }
  /// Time on the robot's clock between a truth sample and the one before.
  double duration_s(std::size_t sample) const { return durations_s_[sample]; }

 private:
  const PreparedRun* run_;
  Unknowns unknowns_;
  std::vector<Move> moves_;
  std::vector<std::size_t> ends_;  // of each truth sample: one behind its last move
  std::vector<double> durations_s_;
};

}  // namespace astro::calibration
