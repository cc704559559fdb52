#pragma once

#include <optional>

#include "host/base/error.hpp"
#include "host/truth/source/pose3.hpp"

namespace astro::truth {

/// The drive contradicts the axis that is taken for up. Values: it, the other one, and by how many metres the
/// body rises.
enum class UpAxisProblem { contradicted };

/// Detects from a body that drives on a floor that not the assumed axis of the tracker points up but the other one. Drives
/// that are recorded with the wrong axis are of no use, so it should be noticed early.
class UpAxisCheck {
 public:
  explicit UpAxisCheck(UpAxis assumed) : assumed_(assumed) {}

  /// Takes the next pose of the body, which has to be a possible one.
  void take(const Pose3& pose);
  /// To be called if the body may be carried elsewhere before the next pose.
  void forget();
  /// Has a value once the body has been 0.3 m higher or lower than at first for a while, and has never moved along the other
  /// axis. A robot that is picked up after a drive has moved along that axis.
  std::optional<Remark> objection() const;

 private:
  UpAxis assumed_;
  std::optional<Pose3> first_;
  double risen_m_ = 0, least_m_ = 0, most_m_ = 0;  // the last two along the other axis
  int contradictions_ = 0;                         // in a row
};

}  // namespace astro::truth
