#pragma once

#include <numbers>

/// A brushed DC gear motor, modelled from its data sheet. All quantities are at the output shaft.
///
/// Electrical   i = (V - Ke w) / R. The winding's inductance is left out: about 1 mH / 1.7 ohm = 0.6 ms is
///              less than one control tick and 1/70 of the mechanical time constant.
/// Mechanical   J dw/dt = Ke i - B w - friction - load. Friction opposes motion and is at most
///              Tc + m Ke |i| while turning, Ts + m Ke |i| at rest: the gear loses a fixed part m of the
///              torque that passes through it. A lower torque constant Kt < Ke would do the same while
///              driving, but would create energy while braking.
///
/// Derivation   with k = (1 - m) Ke and s the part of the no-load torque that is Coulomb friction:
///   stall:    R  = V / I_stall
///   no load:  Ke = (V - R I_0) / w_0
///   no load:  k I_0 = Tc + B w_0,  Tc = s k I_0
///   stall:    k I_stall = T_stall + Tc   =>   k = T_stall / (I_stall - s I_0)
///   start:    Ts = k V_start / R
/// The data sheet does not give s. Tc must be below Ts; 0.8 means that brushes and bearings cause most of the
/// loss.
namespace astro::sim {

/// GB37Y3530-12V-251R.
struct MotorSheet {
  double supply_V = 12.0;
  double no_load_radps = 251.0 * 2.0 * std::numbers::pi / 60.0;
  double no_load_A = 0.35;
  double stall_A = 7.0;
  double stall_Nm = 1.76;
  double start_V = 1.0;
  double coulomb_share = 0.8;
  double rotor_kgm2 = 1.5e-6;  // not in the data sheet: 15 g cm^2, usual for a 35 mm can motor
};

struct Motor {
  double resistance_ohm = 0;
  double emf_Vspr = 0;       // Ke, V s/rad = N m/A
  double mesh_loss = 0;      // m
  double static_Nm = 0;      // Ts
  double coulomb_Nm = 0;     // Tc
  double viscous_Nmspr = 0;  // B
  double inertia_kgm2 = 0;   // J
};

constexpr Motor motor_from(const MotorSheet& sheet, double gear_ratio) {
  const double resistance_ohm = sheet.supply_V / sheet.stall_A;
  const double emf = (sheet.supply_V - resistance_ohm * sheet.no_load_A) / sheet.no_load_radps;
  const double coulomb_A = sheet.coulomb_share * sheet.no_load_A;
  const double through_gear = sheet.stall_Nm / (sheet.stall_A - coulomb_A);
  return {.resistance_ohm = resistance_ohm,
          .emf_Vspr = emf,
          .mesh_loss = 1.0 - through_gear / emf,
          .static_Nm = through_gear * sheet.start_V / resistance_ohm,
          .coulomb_Nm = through_gear * coulomb_A,
          .viscous_Nmspr = through_gear * (sheet.no_load_A - coulomb_A) / sheet.no_load_radps,
          .inertia_kgm2 = sheet.rotor_kgm2 * gear_ratio * gear_ratio};
}

/// The same motor with a stronger magnet: Ke grows, and with it the torque per ampere.
constexpr Motor with_constant_scaled(Motor motor, double factor) {
  motor.emf_Vspr *= factor;
  return motor;
}

}  // namespace astro::sim
