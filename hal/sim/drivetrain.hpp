#pragma once

#include "hal/sim/config.hpp"
#include "hal/sim/motor.hpp"

/// Both motors, the wheels and the body as one machine: the wheels are coupled by the body's mass and yaw
/// inertia and by the common supply.
///
///   M dw/dt = torque - friction,   M = | J + rL^2 (m/4 + I/b^2)   rL rR (m/4 - I/b^2)  |
///                                      | rL rR (m/4 - I/b^2)      J + rR^2 (m/4 + I/b^2) |
///
/// The centre of mass lies on the axle, so there are no velocity products. Wheel slip is modelled elsewhere,
/// as noise on the travel of a rolling wheel (slip.hpp), not as a loss of grip.
///
/// Friction is a bounded impulse per step, solved for both wheels together: a wheel that friction can stop
/// within the step stops exactly and stays; a wheel that friction cannot hold keeps sliding. So a robot at
/// zero duty comes to rest with speed 0.0 and does not chatter.
///
/// Units   left, right; rad/s and N m at the wheel, forward positive.
/// Cost    four steps of 250 us in about 50 ns; 25 ns at rest.
namespace astro::sim {

/// An external load on a wheel. `drag_Nm` only resists (a carpet, a hand, a wall; 100 blocks the wheel);
/// `torque_Nm` can also drive the wheel (a slope).
struct WheelLoad {
  double torque_Nm = 0;
  double drag_Nm = 0;
};

/// State of the H-bridges and the supply during one tick, by wheel.
struct Drive {
  Pair duty{};                 // fraction of the supply; 0 is a short, that is, a brake
  std::array<bool, 2> open{};  // open bridge: its diodes conduct once back-EMF exceeds the supply
  double supply_V = 12.0;      // unloaded
  double supply_ohm = 0.0;
};

class Drivetrain {
 public:
  static constexpr int kStepsPerTick = 4;
  static constexpr double kStep_s = 250e-6;

  explicit Drivetrain(const Config& config);

  /// Runs 1 ms and returns how far each wheel turned, rad.
  Pair advance_tick(const Drive& drive);

  void set_load(Side side, const WheelLoad& load) { load_[at(side)] = load; }

  const Pair& speed_radps() const { return speed_; }
  const Pair& current_A() const { return current_; }
  double bus_V() const { return bus_V_; }  // at the end of the tick
  double kinetic_energy_J() const;

 private:
  // Motor torque during one tick as a function of both speeds: at_rest + slope speed, N m.
  struct Torque {
    Pair at_rest;
    double left, right, between;  // the slope, a symmetric matrix
    Pair operator()(const Pair& speed) const {
      return {at_rest[0] + left * speed[0] + between * speed[1],
              at_rest[1] + between * speed[0] + right * speed[1]};
    }
  };
  // One step while no direction changes: left' = keep_left left + from_right right + always[0], ...
  struct Step {
    double keep_left, from_right, from_left, keep_right;
    Pair always;
    Pair operator()(const Pair& speed) const {
      return {keep_left * speed[0] + (from_right * speed[1] + always[0]),
              keep_right * speed[1] + (from_left * speed[0] + always[1])};
    }
  };
  Drive conducting(const Drive& drive) const;
  Torque torque_for(const Drive& drive) const;
  Step rolling(const Torque& torque, const Pair& motor_Nm) const;
  bool roll(const Torque& torque, Pair& turned);
  Pair creep(const Torque& torque);
  Pair settle(const Pair& push, const Pair& grip) const;
  Pair slide(const Pair& push, const Pair& grip) const;
  Pair gained_by(double left_Nm, double right_Nm) const;
  Pair grip(const Pair& torque_Nm) const;

  std::array<Motor, 2> motor_;
  std::array<WheelLoad, 2> load_{};
  Pair mass_{}, gain_{};  // diagonals of M / step and of its inverse: torque <-> change of speed in one step
  double mass_between_ = 0, gain_between_ = 0;
  double conductance_ = 0;
  Pair amperes_per_Nm_{};
  Pair speed_{}, current_{};
  double bus_V_;
};

}  // namespace astro::sim
