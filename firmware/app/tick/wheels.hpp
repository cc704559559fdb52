#pragma once

#include <cstdint>

#include "common/control/observer.hpp"
#include "common/control/wheel_pair.hpp"
#include "common/kinematics/twist.hpp"
#include "common/safety/wheel_stopped.hpp"
#include "hal/interface/board.hpp"

namespace astro {

/// What a tick reads from the board at its start.
struct TickInput {
  std::uint64_t now_us = 0;
  hal::EncoderCounts counts;
  std::int32_t battery_mv = 0;
  bool driver_fault = false;
  bool on_time = true;  // false: this tick, or the thousand before it, did not come at 1 kHz
};

/// Both wheels: counts to speeds, voltages to duty, with the polarities of encoders and motors.
class Wheels {
 public:
  struct Steps {
    std::int32_t left = 0, right = 0;  // counts of this tick, forward positive
    bool plausible = true;             // false: more counts than a motor can make; they were ignored
  };

  /// What the parameters mean for the tick. It takes divisions, so it is computed outside the tick.
  struct Configuration {
    [[gnu::cold]] Configuration(const ParameterSet& set, const Geometry& wheels);

    Geometry geometry;
    PairGains gains;
    SpeedObserver::Gains observer;
    std::int32_t most_counts, most_late_counts;
    std::int32_t voltage_limit_uv;
    struct Wheel {
      std::int32_t motor_sign, encoder_sign, expected_scale;
    };
    Wheel left, right;
  };
  void configure(const Configuration& configuration);

  /// The first call after a start only takes the decoders' readings as the starting point.
  Steps read(const TickInput& input);

  /// The duty that brings both wheels to the set points, in the bridges' own sign.
  hal::Duty control(const WheelSpeeds& set_points, const WheelSpeeds& accelerations, std::int32_t battery_mv);
  /// The duty that puts these voltages on the motors, as far as the supply allows.
  hal::Duty open_loop(const WheelVoltages& voltages, std::int32_t battery_mv);
  /// Ends control: there is no set point, and the integrals are reset.
  void release();

  const WheelSpeeds& speeds() const { return speeds_; }
  bool stopped() const { return wheel_stopped(speeds_.left_umps) && wheel_stopped(speeds_.right_umps); }
  const WheelSpeeds& set_points() const { return set_points_; }
  const hal::Duty& forward_duty() const { return forward_duty_; }  // forward positive, whatever the polarity
  /// The duty of half of the usable voltage, which is what this supply and motor_voltage_max allow.
  std::int32_t half_duty(std::int32_t battery_mv) const;
  std::int32_t left_counts() const { return left_counts_; }
  std::int32_t right_counts() const { return right_counts_; }
  /// Counts in either direction since start; wraps. More than the travel if the wheel goes to and fro.
  std::uint32_t left_edges() const { return left_.edges; }
  std::uint32_t right_edges() const { return right_.edges; }

 private:
  struct Wheel {
    SpeedObserver observer;
    std::int32_t expected_scale = 0;  // 2^-20 counts per tick and tick, per 1e-6 m/s^2; 2^-32
    std::int32_t expected = 0;        // change of speed in the next tick
    std::int32_t motor_sign = 1;
    std::int32_t encoder_sign = 1;
    std::int32_t seen = 0;    // decoder's last reading
    std::uint32_t edges = 0;  // counts in either direction since start; wraps
  };

  struct Supply {
    std::int32_t mv, limit_uv;
  };

  Supply supply_of(std::int32_t battery_mv) const;
  /// Remembers the forward duty and returns it in the bridges' own sign.
  hal::Duty wired(const hal::Duty& forward);
  std::int32_t step(Wheel& wheel, std::int32_t counts) const;
  /// Precondition: the voltages are within the supply.
  static hal::Duty to_duty(const WheelVoltages& voltages, std::int32_t supply_mv);

  Wheel left_, right_;
  WheelPair pair_;
  Geometry geometry_;
  std::int32_t voltage_limit_uv_ = 0;
  std::int32_t most_counts_ = 0;       // of a tick that is on time: four times over_speed
  std::int32_t most_late_counts_ = 0;  // of any tick: what odometry and observer can take
  bool started_ = false;
  std::int32_t left_counts_ = 0, right_counts_ = 0;
  WheelSpeeds speeds_, set_points_, accelerations_;
  hal::Duty forward_duty_;
};

}  // namespace astro
