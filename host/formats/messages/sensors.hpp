#pragma once

#include <limits>

#include "host/formats/messages/std.hpp"

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
