#pragma once

#include <array>
#include <limits>

#include "host/formats/messages/geometry.hpp"

namespace astro::ros2::msg {

/// Each list has the length of `name`, or is empty.
struct JointState {
  Header header;
  std::vector<std::string> name;
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<double> effort;

  static constexpr std::string_view kType = "sensor_msgs/msg/JointState";
  static constexpr std::tuple kFields{Field{&JointState::header, "header"}, Field{&JointState::name, "name"},
                                      Field{&JointState::position, "position"},
                                      Field{&JointState::velocity, "velocity"},
                                      Field{&JointState::effort, "effort"}};
  bool operator==(const JointState&) const = default;
};

/// One turn of a laser scanner, or the part of it that it sees: radians and metres, seconds between beams and between scans. The
/// stamp is the time of the first beam. intensities has the length of ranges, or is empty.
struct LaserScan {
  Header header;
  float angle_min = 0, angle_max = 0, angle_increment = 0;
  float time_increment = 0, scan_time = 0;
  float range_min = 0, range_max = 0;
  std::vector<float> ranges;
  std::vector<float> intensities;

  static constexpr std::string_view kType = "sensor_msgs/msg/LaserScan";
  static constexpr std::tuple kFields{Field{&LaserScan::header, "header"},
                                      Field{&LaserScan::angle_min, "angle_min"},
                                      Field{&LaserScan::angle_max, "angle_max"},
                                      Field{&LaserScan::angle_increment, "angle_increment"},
                                      Field{&LaserScan::time_increment, "time_increment"},
                                      Field{&LaserScan::scan_time, "scan_time"},
                                      Field{&LaserScan::range_min, "range_min"},
                                      Field{&LaserScan::range_max, "range_max"},
                                      Field{&LaserScan::ranges, "ranges"},
                                      Field{&LaserScan::intensities, "intensities"}};
  bool operator==(const LaserScan&) const = default;
};

/// rad/s and m/s^2; each covariance row by row of x, y, z, all zero if unknown. A first element of -1 says that the quantity is
/// not measured.
struct Imu {
  Header header;
  Quaternion orientation;
  std::array<double, 9> orientation_covariance{};
  Vector3 angular_velocity;
  std::array<double, 9> angular_velocity_covariance{};
  Vector3 linear_acceleration;
  std::array<double, 9> linear_acceleration_covariance{};

  static constexpr std::string_view kType = "sensor_msgs/msg/Imu";
  static constexpr std::tuple kFields{
      Field{&Imu::header, "header"},
      Field{&Imu::orientation, "orientation"},
      Field{&Imu::orientation_covariance, "orientation_covariance"},
      Field{&Imu::angular_velocity, "angular_velocity"},
      Field{&Imu::angular_velocity_covariance, "angular_velocity_covariance"},
      Field{&Imu::linear_acceleration, "linear_acceleration"},
      Field{&Imu::linear_acceleration_covariance, "linear_acceleration_covariance"}};
  bool operator==(const Imu&) const = default;
};

/// V, A, Ah, degrees Celsius; NaN for what is not measured. A discharging current is negative.
struct BatteryState {
  Header header;
  float voltage = std::numeric_limits<float>::quiet_NaN(),
        temperature = std::numeric_limits<float>::quiet_NaN(),
        current = std::numeric_limits<float>::quiet_NaN(), charge = std::numeric_limits<float>::quiet_NaN();
  float capacity = std::numeric_limits<float>::quiet_NaN(),
        design_capacity = std::numeric_limits<float>::quiet_NaN(),
        percentage = std::numeric_limits<float>::quiet_NaN();
  std::uint8_t power_supply_status = 0, power_supply_health = 0, power_supply_technology = 0;
  bool present = false;
  std::vector<float> cell_voltage;
  std::vector<float> cell_temperature;
  std::string location, serial_number;

  static constexpr std::string_view kType = "sensor_msgs/msg/BatteryState";
  static constexpr std::tuple kFields{
      Field{&BatteryState::header, "header"},
      Field{&BatteryState::voltage, "voltage"},
      Field{&BatteryState::temperature, "temperature"},
      Field{&BatteryState::current, "current"},
      Field{&BatteryState::charge, "charge"},
      Field{&BatteryState::capacity, "capacity"},
      Field{&BatteryState::design_capacity, "design_capacity"},
      Field{&BatteryState::percentage, "percentage"},
      Field{&BatteryState::power_supply_status, "power_supply_status"},
      Field{&BatteryState::power_supply_health, "power_supply_health"},
      Field{&BatteryState::power_supply_technology, "power_supply_technology"},
      Field{&BatteryState::present, "present"},
      Field{&BatteryState::cell_voltage, "cell_voltage"},
      Field{&BatteryState::cell_temperature, "cell_temperature"},
      Field{&BatteryState::location, "location"},
      Field{&BatteryState::serial_number, "serial_number"}};
  bool operator==(const BatteryState&) const = default;
};

}  // namespace astro::ros2::msg
