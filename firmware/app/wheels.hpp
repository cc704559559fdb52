#pragma once

#include <cstdint>

#include "common/control/observer.hpp"
#include "common/control/wheel_pair.hpp"
#include "common/kinematics/twist.hpp"
#include "firmware/app/tick_input.hpp"

namespace astro {

/// Both wheels: polarity, counting, speed, and from voltage to duty.
class Wheels {
 public:
  struct Steps {
    std::int32_t left = 0, right = 0;  // counts of this tick, forward positive
    bool plausible = true;             // false: more than a motor can turn; nothing was counted
  };

  /// What the parameters mean for the tick. Takes divisions: made outside the tick.
  struct Configuration {
    [[gnu::cold]] Configuration(const ParameterSet& set, const Geometry& wheels);

    Geometry geometry;
    PairGains gains;
    SpeedObserver::Gains observer;
    std::int32_t most_counts, most_late_counts;
    std::int32_t voltage_limit_uv;
    struct Side {
      std::int32_t motor_sign, encoder_sign, expected_scale;
    };
    Side left, right;
  };
  void configure(const Configuration& configuration);

  /// The first call after a start only learns where the decoders stand.
  Steps read(const TickInput& input);

  /// The duty that brings both wheels to the set points, the bridges' own sense.
  hal::Duty control(const WheelSpeeds& set_points, const WheelSpeeds& accelerations, std::int32_t battery_mv);
  /// The duty that puts these voltages on the motors, as far as the supply goes.
  hal::Duty open_loop(const WheelVoltages& voltages, std::int32_t battery_mv);
  /// No set point: the integrals are forgotten.
  void release();

  const WheelSpeeds& speeds() const { return speeds_; }
  const WheelSpeeds& set_points() const { return set_points_; }
  const hal::Duty& forward_duty() const { return forward_duty_; }  // forward positive, whatever the wiring
  /// The duty that is half of the voltage that this supply and motor_voltage_max allow.
  std::int32_t half_duty(std::int32_t battery_mv) const;
  std::int32_t left_counts() const { return left_counts_; }
  std::int32_t right_counts() const { return right_counts_; }
  /// Counts to either side since start, wraps: more than the way if they go to and fro.
  std::uint32_t left_edges() const { return left_.edges; }
  std::uint32_t right_edges() const { return right_.edges; }

 private:
  struct Side {
    SpeedObserver observer;
    std::int32_t expected_scale = 0;  // 2^-20 counts per tick and tick, per 1e-6 m/s^2; 2^-32
    std::int32_t expected = 0;        // change of speed in the next tick
    std::int32_t motor_sign = 1;
    std::int32_t encoder_sign = 1;
    std::int32_t seen = 0;    // decoder's last reading
    std::uint32_t edges = 0;  // counts to either side since start, wraps
  };

  struct Supply {
    std::int32_t mv, limit_uv;
  };

  Supply supply_of(std::int32_t battery_mv) const;
  /// Remembers the forward duty and turns it into the bridges' own sense.
  hal::Duty wired(const hal::Duty& forward);
  std::int32_t step(Side& side, std::int32_t counts) const;
  /// The voltages are within the supply.
  static hal::Duty to_duty(const WheelVoltages& voltages, std::int32_t supply_mv);

  Side left_, right_;
  WheelPair pair_;
  Geometry geometry_;
  std::int32_t voltage_limit_uv_ = 0;
  std::int32_t most_counts_ = 0;       // in a tick on time: four times over_speed
  std::int32_t most_late_counts_ = 0;  // in any tick: what odometry and observer take
  bool started_ = false;
  std::int32_t left_counts_ = 0, right_counts_ = 0;
  WheelSpeeds speeds_, set_points_, accelerations_;
  hal::Duty forward_duty_;
};

}  // namespace astro
