#pragma once

#include <array>
#include <cstdint>

#include "common/kinematics/arc.hpp"
#include "common/kinematics/heading_filter.hpp"
#include "common/kinematics/slip_watch.hpp"
#include "common/params/parameter_set.hpp"
#include "common/protocol/telemetry.hpp"
#include "firmware/app/tick/drive.hpp"
#include "hal/interface/board.hpp"

namespace astro {

/// A turn of the robot that no wheel has seen.
struct UnseenTurn {
  std::uint64_t time_us = 0;
  std::int16_t turn_100urad = 0;  // so far, 1e-4 rad, counter-clockwise
};

/// The gyro in the control tick: a pose beside the odometry's, with the heading of gyro and wheels together, and the slips that the
/// gyro notices. Nothing here moves the robot or changes its odometry.
///
/// Readings are summed for ten ticks, each held until the next comes. The wheels' part of a step is taken `gyro_lag` earlier, between
/// the steps by linear interpolation. While there is no good reading the pose follows the wheels, and state() says why. Only a gyro
/// that is saturated beyond what the wheels say is followed.
///
/// Cost    a sum in most ticks. Of ten ticks one makes a step, one advances the filter with it, one the watch for slips, and one
///         the pose.
class GyroHeading {
 public:
  using State = protocol::GyroState;

  /// What the parameters mean here. It takes long divisions, so it is computed outside the tick.
  struct Configuration {
    [[gnu::cold]] Configuration(const ParameterSet& set, const Geometry& geometry);

    HeadingFilter::Configuration filter;
    std::int32_t axis, scale_30, lag_ticks;
    std::int64_t left_half_travel, right_half_travel;
    std::uint32_t left_path_28, right_path_28;  // travel of a count, 2^-28 m
    bool slip_stops;
  };
  /// Precondition: the robot stands, or only gains have changed.
  void configure(const Configuration& configuration, const Drive& drive);

  /// The parameters name an axis.
  bool in_use() const { return axis_ != 0; }

  /// Called once a tick, after the drive, or else wait() is. Precondition: in_use(). True in one tick of ten while a slip goes
  /// on that the parameters let stop the robot, so that one which began without power is still seen by a robot that is given power.
  bool advance(const hal::GyroReading& reading, const Drive& drive, std::uint64_t now_us);

  /// Whether a gyro that works is not read in this tick, which is long enough without it; then wait() is called instead of advance().
  bool waits_in(const Drive& drive) const { return works_ && (drive.corrects_path() || filters_in(drive)); }
  void wait(const Drive& drive) {
    ++held_ticks_;
    if (filters_in(drive)) step_filter();
  }

  /// The robot's pose was set: this one is the same.
  void pose_was_set(const Drive& drive);

  /// True once for each slip.
  bool take_slip(UnseenTurn& slip);

  State state() const { return state_; }
  const HeadingFilter& filter() const { return filter_; }
  protocol::FusedGroup report(const Drive& drive, std::uint64_t time_us) const;

 private:
  static constexpr int kTicks = HeadingFilter::kStep_ms;
  static_assert(kTicks == Drive::kPhases);
  static constexpr std::uint32_t kFilterPhase = 1;  // a path is corrected in none of the four phases
  static constexpr std::size_t kHistory = 32;       // steps; the longest lag is 25
  struct Wheels {
    std::uint32_t theta_32 = 0, path_20 = 0;  // both wrap
  };

  /// The newest sample was held for some ticks: its part of the step.
  void hold();
  /// This was so in the present step.
  void note(State now);
  [[gnu::noinline]] void take_sample(const hal::GyroReading& reading);
  static State of_board(hal::GyroReading::State state);
  void note_scale(std::uint32_t count_nradps);
  Wheels wheels_of(const Drive& drive);
  Wheels wheels_at_lag() const;
  void make_step(const Drive& drive);
  static bool filters_in(const Drive& drive) { return drive.phase() == kFilterPhase + 1; }
  void step_filter();
  void step_watch(std::uint64_t now_us);
  void step_pose(const Drive& drive, std::uint64_t now_us);
  void begin_at(const Drive& drive);

  std::int32_t axis_ = 0;  // of the sensor, 1 to 3; negative: it points down; 0: the gyro is not used
  std::size_t up_ = 0;     // where that axis stands in a sample
  std::int32_t sum_ = 0;   // of the readings in this step, counts
  State state_ = State::off, worst_ = State::off;
  std::uint32_t sample_ = 0;            // its number
  int age_ticks_ = 0;                   // of the newest sample, without the ticks that it is held now
  int held_ticks_ = 0;                  // that are not yet in the sum
  std::array<std::int16_t, 3> rate_{};  // of the newest sample
  std::int32_t about_up_ = 0;           // of these the rate about the vertical axis, counter-clockwise
  State of_sample_ = State::silent;
  int same_ = 0;  // samples in a row that are the same in all axes
  std::int16_t temperature_cC_ = hal::GyroReading::kNoTemperature;

  HeadingFilter filter_;
  SlipWatch watch_;
  HeadingStep step_;
  bool stepped_ = false;  // the filter was advanced with step_
  bool partial_ = true;   // the present step began within the ten ticks, and is left out
  bool begins_ = false;   // the pose was set, and no step has begun since
  bool works_ = false;    // the board says so of the gyro
  std::uint32_t count_nradps_ = 0;
  std::int64_t count_48_ = 0;  // turn of a count held for a tick, 2^-48 turn
  std::int32_t scale_30_ = 1 << 30, lag_ticks_ = 0;
  std::array<Wheels, kHistory> history_{};
  std::size_t at_ = 0;                              // of the newest
  std::uint32_t left_edges_ = 0, right_edges_ = 0;  // that the history has
  Wheels lagging_;                                  // at the end of the last step, gyro_lag ago

  ArcIntegrator fused_;
  std::uint64_t fused_us_ = 0;
  std::int64_t left_half_travel_ = 0, right_half_travel_ = 0;
  std::uint32_t left_path_28_ = 0, right_path_28_ = 0;
  std::int32_t left_counts_ = 0, right_counts_ = 0;  // that the pose has
  Angle theta_;                                      // of the odometry, that the pose has
  std::uint64_t correction_64_ = 0;                  // of the filter, that the pose has
  bool slip_stops_ = false, slip_waits_ = false;
  UnseenTurn slip_;
  std::uint16_t slips_ = 0;
};

/// In its place on a board without a gyro.
struct NoGyro {
  struct Configuration {
    Configuration(const ParameterSet&, const Geometry&) {}
  };
  void configure(const Configuration&, const Drive&) {}
  void pose_was_set(const Drive&) {}
  bool take_slip(UnseenTurn&) { return false; }
  protocol::FusedGroup report(const Drive& drive, std::uint64_t time_us) const {
    const Pose& pose = drive.pose();
    return {.time_us = time_us, .x = pose.x, .y = pose.y, .theta = pose.theta.raw(), .turns = pose.turns};
  }
};

}  // namespace astro
