#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "host/calibration/likelihood/matrix3.hpp"
#include "host/calibration/likelihood/sample_selection.hpp"
#include "host/calibration/likelihood/unknowns.hpp"
#include "host/calibration/preparation/prepared_run.hpp"

/// How the robot moved between its truth samples by its wheels alone, for given unknowns. Several passes of the filter share
/// the result.
namespace astro::calibration {

/// The unknowns on which the wheels' path depends, in the order of Move::by.
inline constexpr std::array kMoveUnknowns{kCRight, kCLeft, kB, kE, kSkew, kClockOffset};

/// A change of the robot's pose, in the robot's frame at its beginning.
struct Move {
  double x_m = 0, y_m = 0, turn_rad = 0;
  double cosine = 1, sine = 0;  // of the turn
  Symmetric3 slip_per_K;        // covariance of the change that slip causes, for K = 1 m
  /// Derivatives of the change by each of kMoveUnknowns.
  std::array<Vector3, kMoveUnknowns.size()> by{};
};

/// The motion by `first` and then by `second`.
Move joined(const Move& first, const Move& second);

/// The arc that these nominal wheel travels give on a robot with these factors. Its derivatives by skew and offset of the
/// clocks are zero.
Move move_of(double nominal_right_m, double nominal_left_m, const WheelFactors& factors);

/// The motion from the truth sample of the previous leg to `sample`.
struct Leg {
  std::size_t sample = 0;  // of truth, at its end
  bool moved = false;      // else the wheels stood
  Move move;
  double unknown_m2 = 0;            // variance of each coordinate by gaps of the odometry (PreparedRun::gaps)
  double unknown_rad2 = 0;          // of the heading
  std::array<double, 4> spent_s{};  // in each Motion, on the robot's clock
};

class Moves {
 public:
  /// A leg to each truth sample that one of `selections` takes; without selections to every truth sample. The wheels' path is
  /// made of arcs that end at each truth sample and last kLongestStep_s at most, whatever is selected. The run must outlive
  /// this.
  Moves(const PreparedRun& run, const Unknowns& unknowns, double kappa0 = kUsualKappa0,
        std::vector<SampleSelection> selections = {});

  /// The same legs with other unknowns.
  void change(const Unknowns& unknowns);
  /// The same motion in legs to the truth samples that `selection` takes. Precondition: one of these legs ends at each of them.
  Moves joined(const SampleSelection& selection) const;

  const PreparedRun& run() const { return *run_; }
  const Unknowns& unknowns() const { return unknowns_; }
  std::span<const Leg> legs() const { return legs_; }

 private:
  struct Empty {};
  Moves(const Moves& like, std::vector<SampleSelection> selections, Empty)
      : run_(like.run_),
        kappa0_(like.kappa0_),
        selections_(std::move(selections)),
        unknowns_(like.unknowns_) {}
  bool takes(std::size_t sample) const;

  const PreparedRun* run_;
  double kappa0_;
  std::vector<SampleSelection> selections_;
  Unknowns unknowns_;
  std::vector<Leg> legs_;
};

}  // namespace astro::calibration
