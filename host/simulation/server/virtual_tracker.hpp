#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>

#include "host/recording/run.hpp"
#include "host/truth/source/pose3.hpp"

namespace astro::simulation {

/// What a tracking software adds to what its cameras see.
struct TrackingFaults {
  double latency_s = 0.008;  // from the exposure to the network
  double dropped = 0;        // share of frames that never arrive
  std::uint64_t seed = 1;
};

/// A frame of the tracker.
struct TrackedFrame {
  std::int32_t number = 0;
  std::int64_t exposed_us = 0;  // on the tracker's clock
  truth::Pose3 pose;
};

/// Receives frames as they leave the tracker.
class FrameSink {
 public:
  FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;
  virtual ~FrameSink() = default;

  /// Never waits.
  virtual void send(const TrackedFrame& frame) = 0;
};

/// Makes 3D frames from a robot's poses on the floor, with z up, at the height of its markers, and with the
/// small tilt of an uneven floor. Frames leave after the latency; some are lost. Deterministic.
class VirtualTracker {
 public:
  explicit VirtualTracker(const TrackingFaults& faults) : faults_(faults), random_(faults.seed) {}

  /// Takes a pose that the cameras see now.
  void take(std::int64_t now_us, const recording::TruthSample& sample);
  /// The next frame that is due; call it until there is none.
  std::optional<TrackedFrame> next(std::int64_t now_us);

 private:
  TrackingFaults faults_;
  std::mt19937_64 random_;
  std::deque<TrackedFrame> waiting_;
  std::int32_t frames_ = 0;
};

}  // namespace astro::simulation
