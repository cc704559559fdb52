#include "hal/sim/drivetrain.hpp"

#include <cmath>

namespace astro::sim {

Drivetrain::Drivetrain(const Config& config) : bus_V_(config.supply_V) {
  const Motor motor = motor_from(MotorSheet{}, config.gear_ratio);
  motor_ = {with_constant_scaled(motor, 1.0 - config.motor_mismatch / 2.0),
            with_constant_scaled(motor, 1.0 + config.motor_mismatch / 2.0)};
  conductance_ = 1.0 / motor.resistance_ohm;

  const Geometry geometry = true_geometry(config);
  const double left_m = geometry.diameter_m[0] / 2.0, right_m = geometry.diameter_m[1] / 2.0;
  const double on_ground = config.on_stand ? 0.0 : 1.0;
  const double along_kg = on_ground * config.body_kg / 4.0;
  const double around_kg =
      on_ground * config.yaw_inertia_kgm2 / (geometry.wheelbase_m * geometry.wheelbase_m);
  mass_ = {(motor.inertia_kgm2 + left_m * left_m * (along_kg + around_kg)) / kStep_s,
           (motor.inertia_kgm2 + right_m * right_m * (along_kg + around_kg)) / kStep_s};
  mass_between_ = left_m * right_m * (along_kg - around_kg) / kStep_s;
  const double determinant = mass_[0] * mass_[1] - mass_between_ * mass_between_;
  gain_ = {mass_[1] / determinant, mass_[0] / determinant};
  gain_between_ = -mass_between_ / determinant;
  amperes_per_Nm_ = {1.0 / motor_[0].emf_Vspr, 1.0 / motor_[1].emf_Vspr};
}

double Drivetrain::kinetic_energy_J() const {
  return kStep_s * (0.5 * (mass_[0] * speed_[0] * speed_[0] + mass_[1] * speed_[1] * speed_[1]) +
                    mass_between_ * speed_[0] * speed_[1]);
}

// An open bridge carries no current until back-EMF exceeds the supply; then its diodes connect the motor to
// the supply, like a closed bridge at full duty. Decided once per tick.
Drive Drivetrain::conducting(const Drive& drive) const {
  Drive now = drive;
  for (std::size_t k = 0; k < 2; ++k) {
    if (!drive.open[k]) continue;
    const double emf_V = motor_[k].emf_Vspr * speed_[k];
    now.open[k] = std::abs(emf_V) <= drive.supply_V;
    now.duty[k] = now.open[k] ? 0.0 : std::copysign(1.0, emf_V);
  }
  return now;
}

// i = (duty bus - Ke w) / R for both, and bus = supply - supply_ohm sum(duty i), solved for the torques Ke i.
Drivetrain::Torque Drivetrain::torque_for(const Drive& drive) const {
  const double left = drive.open[0] ? 0.0 : motor_[0].emf_Vspr,
               right = drive.open[1] ? 0.0 : motor_[1].emf_Vspr;
  const double duty_left = drive.duty[0], duty_right = drive.duty[1];
  const double droop = drive.supply_ohm * conductance_;
  const double gain = conductance_ / (1.0 + droop * (duty_left * duty_left + duty_right * duty_right));
  const double stiffness = droop * gain;
  return {{left * duty_left * gain * drive.supply_V, right * duty_right * gain * drive.supply_V},
          left * left * (stiffness * duty_left * duty_left - conductance_),
          right * right * (stiffness * duty_right * duty_right - conductance_),
          left * right * stiffness * duty_left * duty_right};
}

Pair Drivetrain::advance_tick(const Drive& drive) {
  const Drive now = drive.open[0] || drive.open[1] ? conducting(drive) : drive;
  const Torque torque = torque_for(now);
  Pair turned{};
  if (!roll(torque, turned)) turned = creep(torque);
  const Pair torque_Nm = torque(speed_);
  current_ = {torque_Nm[0] * amperes_per_Nm_[0], torque_Nm[1] * amperes_per_Nm_[1]};
  bus_V_ = now.supply_V - now.supply_ohm * (now.duty[0] * current_[0] + now.duty[1] * current_[1]);
  return turned;
}

inline Pair Drivetrain::gained_by(double left_Nm, double right_Nm) const {
  return {gain_[0] * left_Nm + gain_between_ * right_Nm, gain_between_ * left_Nm + gain_[1] * right_Nm};
}

// If all directions are known, friction is linear in the speeds like everything else, and a step is an affine
// map.
inline Drivetrain::Step Drivetrain::rolling(const Torque& torque, const Pair& motor_Nm) const {
  const double through_left = 1.0 - std::copysign(motor_[0].mesh_loss, motor_Nm[0] * speed_[0]);
  const double through_right = 1.0 - std::copysign(motor_[1].mesh_loss, motor_Nm[1] * speed_[1]);
  const double dry_left = std::copysign(motor_[0].coulomb_Nm + load_[0].drag_Nm, speed_[0]);
  const double dry_right = std::copysign(motor_[1].coulomb_Nm + load_[1].drag_Nm, speed_[1]);
  const Pair by_left =
      gained_by(through_left * torque.left - motor_[0].viscous_Nmspr, through_right * torque.between);
  const Pair by_right =
      gained_by(through_left * torque.between, through_right * torque.right - motor_[1].viscous_Nmspr);
  return {1.0 + by_left[0], by_right[0], by_left[1], 1.0 + by_right[1],
          gained_by(through_left * torque.at_rest[0] + load_[0].torque_Nm - dry_left,
                    through_right * torque.at_rest[1] + load_[1].torque_Nm - dry_right)};
}

// The usual tick: both wheels and both motor torques keep their direction. If not, returns false and does
// nothing.
bool Drivetrain::roll(const Torque& torque, Pair& turned) {
  if (speed_[0] == 0.0 || speed_[1] == 0.0) return false;
  const Pair before = torque(speed_);
  const Step step = rolling(torque, before);
  const Pair one = step(speed_), two = step(one), three = step(two), four = step(three);
  static_assert(kStepsPerTick == 4);

  const Pair after = torque(four);
  const bool same_sense = four[0] * speed_[0] > 0.0 && four[1] * speed_[1] > 0.0 &&
                          after[0] * before[0] >= 0.0 && after[1] * before[1] >= 0.0;
  if (!same_sense) return false;
  // With the mean of the speeds before and after each step, work and kinetic energy balance exactly.
  turned = {kStep_s * (0.5 * (speed_[0] + four[0]) + one[0] + two[0] + three[0]),
            kStep_s * (0.5 * (speed_[1] + four[1]) + one[1] + two[1] + three[1])};
  speed_ = four;
  return true;
}

// A tick in which a wheel starts, stops, stays stopped or reverses: step by step, with all cases.
Pair Drivetrain::creep(const Torque& torque) {
  Pair turned{};
  for (int step = 0; step < kStepsPerTick; ++step) {
    const Pair motor_Nm = torque(speed_), before = speed_;
    const Pair push = {mass_[0] * before[0] + mass_between_ * before[1] + motor_Nm[0] -
                           motor_[0].viscous_Nmspr * before[0] + load_[0].torque_Nm,
                       mass_between_ * before[0] + mass_[1] * before[1] + motor_Nm[1] -
                           motor_[1].viscous_Nmspr * before[1] + load_[1].torque_Nm};
    speed_ = settle(push, grip(motor_Nm));
    turned[0] += 0.5 * kStep_s * (before[0] + speed_[0]);
    turned[1] += 0.5 * kStep_s * (before[1] + speed_[1]);
    if (turned[0] == 0.0 && turned[1] == 0.0) break;  // friction holds both: nothing changes in this tick
  }
  return turned;
}

// The most that friction can oppose at each wheel.
Pair Drivetrain::grip(const Pair& torque_Nm) const {
  Pair most{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double dry_Nm = speed_[k] != 0.0 ? motor_[k].coulomb_Nm : motor_[k].static_Nm;
    most[k] = dry_Nm + load_[k].drag_Nm + motor_[k].mesh_loss * std::abs(torque_Nm[k]);
  }
  return most;
}

// Speeds after a step that starts with the momentum `push` (as a torque for one step). Of all cases the one
// is taken in which friction is consistent with the motion. M is positive definite, so there is exactly one;
// kSlack covers rounding between two cases.
Pair Drivetrain::settle(const Pair& push, const Pair& grip) const {
  constexpr double kSlack = 1.0 + 1e-12;
  const bool left_moves = std::abs(push[0]) > grip[0], right_moves = std::abs(push[1]) > grip[1];
  if (!left_moves && !right_moves) return {0.0, 0.0};
  if (right_moves) {  // left stands?
    const double right = (push[1] - std::copysign(grip[1], push[1])) / mass_[1];
    if (std::abs(push[0] - mass_between_ * right) <= grip[0] * kSlack) return {0.0, right};
  }
  if (left_moves) {  // right stands?
    const double left = (push[0] - std::copysign(grip[0], push[0])) / mass_[0];
    if (std::abs(push[1] - mass_between_ * left) <= grip[1] * kSlack) return {left, 0.0};
  }
  return slide(push, grip);
}

// Both wheels move: friction opposes the speeds that result.
Pair Drivetrain::slide(const Pair& push, const Pair& grip) const {
  for (const double left : {1.0, -1.0}) {
    for (const double right : {1.0, -1.0}) {
      const Pair then = gained_by(push[0] - left * grip[0], push[1] - right * grip[1]);
      if (left * then[0] > 0.0 && right * then[1] > 0.0) return then;
    }
  }
  return {0.0, 0.0};
}

}  // namespace astro::sim
