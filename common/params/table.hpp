#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/params/row.hpp"

namespace astro {

/// Every parameter of the robot. The numbers are stored and sent, so they are append only and never reused.
enum class Param : std::uint16_t {
  none = 0,  // no parameter; names nothing
  c_R,
  c_L,
  b,
  wheel_diameter,
  counts_per_motor_rev,
  gear_numerator,
  gear_denominator,
  motor_polarity_left,
  motor_polarity_right,
  encoder_polarity_left,
  encoder_polarity_right,
  kp,
  ki,
  kS_left,
  kV_left,
  kA_left,
  observer_bandwidth,
  path_k_along,
  path_k_cross,
  path_k_heading,
  speed_limit,
  yaw_rate_limit,
  acceleration_limit,
  yaw_acceleration_limit,
  command_timeout,
  telemetry_period,
  motor_voltage_max,
  battery_low,
  battery_high,
  over_speed,
  robot_name,
  kS_right,
  kV_right,
  kA_right,
  k_sync,
  jerk_limit,
  yaw_jerk_limit,
  stall_time,
  e,
  kappa0,
  gyro_axis,
  gyro_scale,
  gyro_lag,
  gyro_slip_stops,
};

/// THE parameter table: row i has id i + 1. Add a parameter by appending its id above and its row here;
/// storage, validation, the link and the host tools follow from the row.
///
/// A row reads: id, name, unit, fraction bits or decimal digits, {default, minimum, maximum}, doc.
inline constexpr auto kParamTable = std::to_array<ParamRow>({
    binary_row(Param::c_R, "c_R", "1", 30, {1.0, 0.5, 1.5},
               "Right wheel correction: true over nominal travel; found by calibration"),
    binary_row(Param::c_L, "c_L", "1", 30, {1.0, 0.5, 1.5},
               "Left wheel correction: true over nominal travel; found by calibration"),
    decimal_row(Param::b, "b", "m", 9, {0.29, 0.05, 2.0},
                "Wheelbase: distance between the contact points of the wheels"),
    decimal_row(Param::wheel_diameter, "wheel_diameter", "m", 9, {0.072, 0.01, 1.0},
                "Nominal diameter of both driven wheels"),
    integer_row(Param::counts_per_motor_rev, "counts_per_motor_rev", "count", {64, 1, 65536},
                "Encoder counts per motor revolution, all four edges counted"),
    integer_row(Param::gear_numerator, "gear_numerator", "1", {438, 1, 1'000'000},
                "Gear ratio numerator: motor revolutions per gear_denominator wheel turns"),
    integer_row(Param::gear_denominator, "gear_denominator", "1", {10, 1, 1'000'000},
                "Gear ratio denominator: wheel turns per gear_numerator motor revolutions"),
    integer_row(Param::motor_polarity_left, "motor_polarity_left", "1", {1, -1, 1},
                "+1 or -1: sign of the duty that drives the left wheel forward"),
    integer_row(Param::motor_polarity_right, "motor_polarity_right", "1", {1, -1, 1},
                "+1 or -1: sign of the duty that drives the right wheel forward"),
    integer_row(Param::encoder_polarity_left, "encoder_polarity_left", "1", {1, -1, 1},
                "+1 or -1: sign of the counts while the left wheel rolls forward"),
    integer_row(Param::encoder_polarity_right, "encoder_polarity_right", "1", {1, -1, 1},
                "+1 or -1: sign of the counts while the right wheel rolls forward"),
    binary_row(Param::kp, "kp", "Vs/m", 16, {60, 0, 1000}, "Wheel speed control: proportional gain"),
    binary_row(Param::ki, "ki", "V/m", 16, {1200, 0, 30'000}, "Wheel speed control: integral gain"),
    binary_row(Param::kS_left, "kS_left", "V", 16, {0.5, 0, 50},
               "Left feed-forward: voltage that overcomes static friction"),
    binary_row(Param::kV_left, "kV_left", "Vs/m", 16, {12.2, 0, 1000},
               "Left feed-forward: voltage per wheel speed (back-EMF)"),
    binary_row(Param::kA_left, "kA_left", "Vs^2/m", 16, {1.1, 0, 100},
               "Left feed-forward: voltage per wheel acceleration"),
    binary_row(Param::observer_bandwidth, "observer_bandwidth", "rad/s", 16, {200, 1, 500},
               "Wheel speed observer: bandwidth"),
    binary_row(Param::path_k_along, "path_k_along", "1/s", 16, {8, 0, 1000},
               "Path following: gain on the error along the path"),
    binary_row(Param::path_k_cross, "path_k_cross", "1/m^2", 16, {60, 0, 10'000},
               "Path following: gain on the error across the path"),
    binary_row(Param::path_k_heading, "path_k_heading", "1/s", 16, {10, 0, 10'000},
               "Path following: gain on the heading error"),
    decimal_row(Param::speed_limit, "speed_limit", "m/s", 6, {0.75, 0.01, 10},
                "Fastest forward or backward speed that is commanded"),
    decimal_row(Param::yaw_rate_limit, "yaw_rate_limit", "rad/s", 6, {2.0, 0.01, 50},
                "Fastest yaw rate that is commanded"),
    decimal_row(Param::acceleration_limit, "acceleration_limit", "m/s^2", 6, {0.5, 0.01, 50},
                "Steepest change of commanded speed"),
    decimal_row(Param::yaw_acceleration_limit, "yaw_acceleration_limit", "rad/s^2", 6, {3.0, 0.01, 500},
                "Steepest change of commanded yaw rate"),
    integer_row(Param::command_timeout, "command_timeout", "ms", {200, 0, 60'000},
                "The robot stops when no command has come for this long; 0 disables"),
    // The row stays, because ids are append-only and a set that is stored in a robot or in a file may hold it.
    integer_row(Param::telemetry_period, "telemetry_period", "ms", {10, 0, 60'000},
                "Not read any more: a host says how often when it asks for telemetry"),
    decimal_row(Param::motor_voltage_max, "motor_voltage_max", "V", 3, {12, 1, 50},
                "Most voltage that may be put on a motor, whatever the battery gives"),
    integer_row(Param::battery_low, "battery_low", "mV", {10'500, 0, 60'000},
                "The robot stops below this motor supply voltage; 0 disables"),
    integer_row(Param::battery_high, "battery_high", "mV", {14'000, 0, 60'000},
                "The robot stops above this motor supply voltage; 0 disables"),
    decimal_row(Param::over_speed, "over_speed", "m/s", 6, {1.2, 0.02, 20},
                "The robot stops when a wheel is measured faster"),
    text_row(Param::robot_name, "robot_name", "ASTRO", 1, 24, "What people call this robot: printable ASCII"),
    binary_row(Param::kS_right, "kS_right", "V", 16, {0.5, 0, 50},
               "Right feed-forward: voltage that overcomes static friction"),
    binary_row(Param::kV_right, "kV_right", "Vs/m", 16, {12.2, 0, 1000},
               "Right feed-forward: voltage per wheel speed (back-EMF)"),
    binary_row(Param::kA_right, "kA_right", "Vs^2/m", 16, {1.1, 0, 100},
               "Right feed-forward: voltage per wheel acceleration"),
    binary_row(Param::k_sync, "k_sync", "1/s", 16, {6, 0, 400},
               "Wheel coupling: how fast a wheel that fell behind is waited for and catches up"),
    decimal_row(Param::jerk_limit, "jerk_limit", "m/s^3", 3, {20, 0, 1000},
                "Steepest change of commanded acceleration, at least twice the limit per second; 0: none"),
    decimal_row(
        Param::yaw_jerk_limit, "yaw_jerk_limit", "rad/s^3", 3, {120, 0, 10'000},
        "Steepest change of commanded yaw acceleration, at least twice the limit per second; 0: none"),
    integer_row(Param::stall_time, "stall_time", "ms", {300, 50, 5000},
                "The robot stops when half the voltage or more does not move a wheel for this long"),
    binary_row(Param::e, "e", "1", 30, {0, -0.2, 0.2},
               "Curvature effect: gentle arcs turn about b (1 + e), spins about b; 0: both about b"),
    decimal_row(Param::kappa0, "kappa0", "1/b", 6, {0.12, 0.01, 10},
                "Curvature effect: the curvature of a path, times b, at which half of e acts"),
    integer_row(
        Param::gyro_axis, "gyro_axis", "1", {0, -3, 3},
        "Axis of the gyro that points up: 1 x, 2 y, 3 z, negative if it points down; 0: no gyro is used"),
    binary_row(Param::gyro_scale, "gyro_scale", "1", 30, {1.0, 0.5, 1.5},
               "Gyro: the turn that it measures over the true turn"),
    decimal_row(Param::gyro_lag, "gyro_lag", "s", 3, {0.005, 0, 0.25},
                "Gyro: time from a motion to its reading, beyond that of the encoders"),
    integer_row(Param::gyro_slip_stops, "gyro_slip_stops", "1", {0, 0, 1},
                "1: the robot stops when the gyro notices a turn that the wheels do not; 0: it only says so"),
});

inline constexpr std::size_t kParamCount = kParamTable.size();

/// Index of the row of `id`. Precondition: the table has it.
constexpr std::size_t param_index(Param id) { return static_cast<std::size_t>(id) - 1; }
constexpr const ParamRow& param_row(Param id) { return kParamTable[param_index(id)]; }

/// The row with this id or name, or nullptr: ids and names come from flash and hosts and may be unknown.
constexpr const ParamRow* find_param(std::uint16_t id) {
  return id >= 1 && id <= kParamCount ? &kParamTable[id - 1U] : nullptr;
}
constexpr const ParamRow* find_param(std::string_view name) {
  for (const ParamRow& row : kParamTable) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

}  // namespace astro
