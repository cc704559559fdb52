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
  mass_ = {motor.inertia_kgm2 + left_m * left_m * (along_kg + around_kg),
           motor.inertia_kgm2 + right_m * right_m * (along_kg + around_kg)};
  mass_between_ = left_m * right_m * (along_kg - around_kg);
  const double determinant = mass_[0] * mass_[1] - mass_between_ * mass_between_;
  lightness_ = {mass_[1] / determinant, mass_[0] / determinant};
  lightness_between_ = -mass_between_ / determinant;
}

double Drivetrain::kinetic_energy_J() const {
  return 0.5 * (mass_[0] * speed_[0] * speed_[0] + mass_[1] * speed_[1] * speed_[1]) +
         mass_between_ * speed_[0] * speed_[1];
}

// The bus feeds duty-weighted currents and sags by their sum, which depends on the bus: solved in closed
// form.
Drivetrain::Bus Drivetrain::bus_for(const Drive& drive) const {
  const double droop = drive.supply_ohm * conductance_;
  const double squares = drive.duty[0] * drive.duty[0] + drive.duty[1] * drive.duty[1];
  return {drive.supply_V, droop, 1.0 / (1.0 + droop * squares)};
}

void Drivetrain::flow(const Drive& drive, const Bus& bus) {
  const Pair emf = {motor_[0].emf_Vspr * speed_[0], motor_[1].emf_Vspr * speed_[1]};
  bus_V_ = (bus.supply_V + bus.droop * (drive.duty[0] * emf[0] + drive.duty[1] * emf[1])) * bus.gain;
  for (std::size_t k = 0; k < 2; ++k) {
    if (drive.open[k]) {
      const double excess_V = std::abs(emf[k]) - bus_V_;
      current_[k] = excess_V > 0.0 ? -std::copysign(excess_V, emf[k]) * conductance_ : 0.0;
    } else {
      current_[k] = (drive.duty[k] * bus_V_ - emf[k]) * conductance_;
    }
  }
}

Pair Drivetrain::advance_tick(const Drive& drive) {
  const Bus bus = bus_for(drive);
  Pair turned{};
  for (int step = 0; step < kStepsPerTick; ++step) {
    flow(drive, bus);
    Pair push, grip;  // impulses
    for (std::size_t k = 0; k < 2; ++k) {
      const Motor& motor = motor_[k];
      const double torque_Nm = motor.emf_Vspr * current_[k];
      const double dry_Nm = speed_[k] != 0.0 ? motor.coulomb_Nm : motor.static_Nm;
      push[k] = kStep_s * (torque_Nm - motor.viscous_Nmspr * speed_[k] + load_[k].torque_Nm);
      grip[k] = kStep_s * (dry_Nm + load_[k].drag_Nm + motor.mesh_loss * std::abs(torque_Nm));
    }
    const Pair next = resolve(push, grip);
    // The mean of both speeds makes work and kinetic energy balance exactly in every step.
    for (std::size_t k = 0; k < 2; ++k) turned[k] += 0.5 * kStep_s * (speed_[k] + next[k]);
    if (next[0] == 0.0 && next[1] == 0.0 && speed_[0] == 0.0 && speed_[1] == 0.0)
      break;  // held: no news this tick
    speed_ = next;
  }
  return turned;
}

Pair Drivetrain::after(const Pair& impulse) const {
  return {speed_[0] + lightness_[0] * impulse[0] + lightness_between_ * impulse[1],
          speed_[1] + lightness_between_ * impulse[0] + lightness_[1] * impulse[1]};
}

Pair Drivetrain::resolve(const Pair& push, const Pair& grip) const {
  const Pair next = after({push[0] - std::copysign(grip[0], speed_[0]),  //
                           push[1] - std::copysign(grip[1], speed_[1])});
  if (next[0] * speed_[0] > 0.0 && next[1] * speed_[1] > 0.0) return next;
  return settle(push, grip);
}

// A wheel starts, stops or turns round: find the one consistent case. M is positive definite, so exactly one
// exists; rounding at a border between two cases is covered by kSlack.
Pair Drivetrain::settle(const Pair& push, const Pair& grip) const {
  constexpr double kSlack = 1.0 + 1e-12;
  constexpr double kSigns[] = {1.0, -1.0};
  const Pair free = after(push);

  const Pair stop = {mass_[0] * free[0] + mass_between_ * free[1],
                     mass_between_ * free[0] + mass_[1] * free[1]};
  if (std::abs(stop[0]) <= grip[0] && std::abs(stop[1]) <= grip[1]) return {0.0, 0.0};

  for (std::size_t held = 0; held < 2; ++held) {
    const std::size_t sliding = 1 - held;
    for (const double sign : kSigns) {
      const double drag = -sign * grip[sliding];
      const double hold = -(free[held] + lightness_between_ * drag) / lightness_[held];
      const double speed = free[sliding] + lightness_[sliding] * drag + lightness_between_ * hold;
      if (std::abs(hold) > grip[held] * kSlack || sign * speed <= 0.0) continue;
      Pair next{};
      next[sliding] = speed;
      return next;
    }
  }
  for (const double left : kSigns) {
    for (const double right : kSigns) {
      const Pair next = after({push[0] - left * grip[0], push[1] - right * grip[1]});
      if (left * next[0] > 0.0 && right * next[1] > 0.0) return next;
    }
  }
  return {0.0, 0.0};
}

}  // namespace astro::sim
