#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/lidar/scan.hpp"
#include "host/recording/run.hpp"

/// Where ground truth comes from while a robot drives.
namespace astro::truth {

/// A stream of poses of the tracked body, in the tracker's own frame.
///
/// Threads one.
class Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;

  /// To be called before a run, while the robot is at rest and not armed. Returns once ground truth comes, within a bounded
  /// time, and discards earlier samples. Throws astro::Error that says why none comes.
  virtual void begin_run() {}

  /// All samples that arrived since the last call, oldest first; never waits. Times are on the clock that
  /// clock() names. Throws astro::Error if the tracker is gone.
  virtual std::vector<recording::TruthSample> poll() = 0;

  /// The scans of a laser scanner on the robot that came since the last call, oldest first, on the same clock; never waits. They are
  /// no poses: those follow from them after the run. Throws as poll().
  virtual std::vector<lidar::Scan> take_scans() { return {}; }

  /// Whether truth comes from complete(), that is from people or files. Then the drive is saved before they
  /// are asked, so that it cannot be lost.
  virtual bool comes_afterwards() const { return false; }

  /// To be called after a run. Returns samples that exist only when the robot is at rest at the end (a tape measure, a file).
  /// `run` holds the odometry of the whole run, including the rests at both ends. Empty for sources that stream. Nothing if
  /// the person who was asked wants the run to be driven again.
  virtual std::optional<std::vector<recording::TruthSample>> complete(const recording::Run& run) {
    static_cast<void>(run);
    return std::vector<recording::TruthSample>{};
  }

  /// What a person should know about the source now that it is open: one clause, or "".
  virtual std::string description() const { return ""; }

  /// "sim", "vrpn", ...: the name in recordings.
  virtual std::string name() const = 0;
  /// "robot", "host" (this computer's steady clock, in microseconds), or what else the times mean.
  virtual std::string clock() const = 0;
};

/// No ground truth.
class NoSource : public Source {
 public:
  std::vector<recording::TruthSample> poll() override { return {}; }
  std::string name() const override { return ""; }
  std::string clock() const override { return ""; }
};

/// Ground truth that comes for many runs at once, after all of them: a film. Until then the recordings have none, and their
/// `truth_source` says what they wait for.
class LaterSource : public Source {
 public:
  explicit LaterSource(std::string name) : name_(std::move(name)) {}

  std::vector<recording::TruthSample> poll() override { return {}; }
  std::string name() const override { return name_; }
  std::string clock() const override { return name_; }

 private:
  std::string name_;
};

}  // namespace astro::truth
