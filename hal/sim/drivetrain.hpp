#pragma once

#include "hal/sim/config.hpp"
#include "hal/sim/motor.hpp"

/// Both motors, the wheels and the body as one machine: the two wheels feel each other through the body's
/// mass and yaw inertia, and through the shared supply.
///
///   M dw/dt = torque - friction,   M = | J + rL^2 (m/4 + I/b^2)   rL rR (m/4 - I/b^2)  |
///                                      | rL rR (m/4 - I/b^2)      J + rR^2 (m/4 + I/b^2) |
///
/// The centre of mass lies on the axle, so no velocity products appear. Wheel slip is not in here: it is
/// noise on the travel of a rolling wheel (slip.hpp), not a loss of grip.
///
/// Friction is an impulse bounded per step, solved for both wheels together: a wheel that friction can stop
/// within the step stops exactly and stays, a wheel that it cannot hold goes on sliding. So a robot at zero
/// duty comes to rest with speed 0.0 and does not chatter.
///
/// Units   left, right; rad/s and N m at the wheel, forward positive.
/// Cost    four steps of 250 us in about 70 ns; next to nothing at rest.
namespace astro::sim {

/// What hangs on a wheel from outside. `drag_Nm` only resists (a carpet, a hand, a wall: 100 blocks the
/// wheel); `torque_Nm` also drives (a slope).
struct WheelLoad {
  double torque_Nm = 0;
  double drag_Nm = 0;
};

/// State of the H-bridges and the supply during one tick, as the wheels see it.
struct Drive {
  Pair duty{};                 // fraction of the supply; 0 is a short, that is, a brake
  std::array<bool, 2> open{};  // open bridge: current flows only when back-EMF exceeds the supply
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
  double bus_V() const { return bus_V_; }
  double kinetic_energy_J() const;

 private:
  struct Bus {
    double supply_V, droop, gain;  // bus = (supply + droop sum(duty emf)) gain
  };
  Bus bus_for(const Drive& drive) const;
  void flow(const Drive& drive, const Bus& bus);
  Pair resolve(const Pair& push, const Pair& grip) const;
  Pair settle(const Pair& push, const Pair& grip) const;
  Pair after(const Pair& impulse) const;

  std::array<Motor, 2> motor_;
  std::array<WheelLoad, 2> load_{};
  Pair mass_{}, lightness_{};  // diagonals of M and of its inverse
  double mass_between_ = 0, lightness_between_ = 0;
  double conductance_ = 0;
  Pair speed_{}, current_{};
  double bus_V_;
};

}  // namespace astro::sim
