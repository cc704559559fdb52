#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/side.hpp"
#include "hal/sim/noise.hpp"

/// A simulated robot: its geometry as designed and as built, its noise, its wiring, its supply.
namespace astro::sim {

/// One value per wheel, indexed by `at`.
using Pair = std::array<double, 2>;

/// Wiring as found on a robot that somebody else built. A reversed motor has its leads exchanged (its encoder
/// stays as it is); a reversed encoder has its two channels exchanged; swapped means left and right are
/// exchanged; dead means that the cable is off; an encoder with a lost channel shows the decoder only the
/// other one.
struct Wiring {
  bool left_motor_reversed = false, right_motor_reversed = false, motors_swapped = false;
  bool left_encoder_reversed = false, right_encoder_reversed = false, encoders_swapped = false;
  bool left_motor_dead = false, right_motor_dead = false;
  bool left_encoder_dead = false, right_encoder_dead = false;
  bool left_channel_lost = false, right_channel_lost = false;
};

/// The outline of the body over the floor, by the point midway between the wheels.
struct Body {
  double ahead_m = 0.1625, behind_m = 0.1625, width_m = 0.337;
  double front_turned_rad = 0;  // a front that is not mounted square to the axle; counter-clockwise positive
  double front_play_rad =
      0;  // standard deviation of that from one touch of a wall to the next: a loose bumper
};

/// A straight wall (wall.hpp).
struct WallConfig {
  double x_m = 0.5, y_m = 0;           // a point of it
  double out_rad = 3.141592653589793;  // the direction in which it faces, into the room
  double stiffness_Npm = 1e4;          // of wall and body at a corner: 1 mm under 10 N
  double damping_Nspm = 100;
  double friction = 0.3;    // along the wall
  double unevenness_m = 0;  // standard deviation of the surface, at points 0.1 m apart
};

/// A rate gyro on the body (gyro.hpp). The noise is that of a FXAS21002C.
struct GyroConfig {
  double angle_random_walk_rad = 4.363e-4;  // per root second: 0.025 degrees
  double bias_radps = 0.02;
  double bias_walk_radps = 1.745e-5;  // per root second: 0.001 degrees a second
  double bias_per_K_radps = 0;        // for each degree of difference to 25 degrees Celsius
  double scale = 1.0;                 // what it says of what it turns
  double lag_s = 0;  // from the motion to the sample, besides half a sample period; whole milliseconds
  double temperature_C = 25;
  int axis = 3;  // the sensor's axis that points up: 1 x, 2 y, 3 z; negative: it points down
};

struct Config {
  // As designed: the parameters of an uncalibrated robot.
  double nominal_diameter_m = 0.072;
  double nominal_wheelbase_m = 0.290;
  double counts_per_motor_rev = 64.0;  // 16 pulses, both channels, both edges
  double gear_ratio = 43.8;

  // As built.
  double true_wheelbase_m = 0.290;
  double true_ed = 1.0;         // D_R / D_L
  double scale = 1.0;           // mean true diameter over nominal diameter
  double true_e = 0.0;          // curvature effect: gentle arcs turn about true_wheelbase_m (1 + true_e)
  double true_kappa0 = 0.12;    // half of true_e acts at this curvature times the wheelbase
  double motor_mismatch = 0.0;  // right motor constant over left, minus one
  double body_kg = 4.7;
  double yaw_inertia_kgm2 = 0.0858;  // uniform 0.325 m x 0.337 m plate of 4.7 kg: m (a^2 + b^2) / 12
  bool on_stand = false;             // the wheels are off the ground and only move themselves
  Body body;
  std::optional<WallConfig> wall;
  std::optional<GyroConfig> gyro;
  double grip_N =
      13.0;  // the most a tyre can push before it skids, counted only against a wall: 0.8 of a third of the weight
  Wiring wiring;

  // Noise: the travel of each wheel has variance slip_m * |distance|. The default gives the scatter of the
  // thesis.
  double slip_m = 2.645e-6;
  double restart_slip_rad =
      0.0;  // jump of the heading when the robot starts after a spin and a second's stand
  std::uint64_t seed = 1;
  std::uint64_t serial_number = 0;  // with the seed it decides the board's unique id

  // Motor supply seen from the H-bridges: battery, regulator and leads as one source with one resistance.
  double supply_V = 12.0;
  double supply_ohm = 0.08;

  // Content of the flash at power-on; if empty the flash is erased.
  std::vector<std::uint8_t> flash;
};

struct Geometry {
  Pair diameter_m{};  // left, right
  double wheelbase_m = 0;
  double e = 0, kappa0 = 0.12;
};

/// The geometry that the robot really has: D_R / D_L = true_ed and D_R + D_L = 2 scale nominal_diameter_m.
constexpr Geometry true_geometry(const Config& config) {
  const double left_m = 2.0 * config.scale * config.nominal_diameter_m / (1.0 + config.true_ed);
  return {{left_m, config.true_ed * left_m}, config.true_wheelbase_m, config.true_e, config.true_kappa0};
}

/// What decides the board's unique id.
constexpr std::uint64_t identity_of(const Config& config) {
  constexpr std::uint64_t kSerialStream = 0x5E;
  return config.serial_number == 0 ? config.seed : hash(config.seed, kSerialStream, config.serial_number);
}

}  // namespace astro::sim
