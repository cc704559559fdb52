#include "common/params/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <string_view>

#include "common/params/parameter_set.hpp"

namespace astro {
namespace {

// Robots carry their calibration under these numbers through every update of the firmware: a number that
// moved would load a battery limit as a motor voltage. Append; a row that is not wanted any more stays.
TEST(ParamTable, IdsAreForEver) {
  constexpr std::string_view kNames[] = {"c_R",
                                         "c_L",
                                         "b",
                                         "wheel_diameter",
                                         "counts_per_motor_rev",
                                         "gear_numerator",
                                         "gear_denominator",
                                         "motor_polarity_left",
                                         "motor_polarity_right",
                                         "encoder_polarity_left",
                                         "encoder_polarity_right",
                                         "kp",
                                         "ki",
                                         "kS_left",
                                         "kV_left",
                                         "kA_left",
                                         "observer_bandwidth",
                                         "path_k_along",
                                         "path_k_cross",
                                         "path_k_heading",
                                         "speed_limit",
                                         "yaw_rate_limit",
                                         "acceleration_limit",
                                         "yaw_acceleration_limit",
                                         "command_timeout",
                                         "telemetry_period",
                                         "motor_voltage_max",
                                         "battery_low",
                                         "battery_high",
                                         "over_speed",
                                         "robot_name",
                                         "kS_right",
                                         "kV_right",
                                         "kA_right",
                                         "k_sync",
                                         "jerk_limit",
                                         "yaw_jerk_limit",
                                         "stall_time",
                                         "e",
                                         "kappa0"};
  for (std::size_t i = 0; i < std::size(kNames); ++i) {
    const ParamRow* row = find_param(static_cast<std::uint16_t>(i + 1));
    ASSERT_NE(row, nullptr) << kNames[i];
    EXPECT_EQ(row->name, kNames[i]);
  }
}

TEST(ParamTable, IdsAreTheRowNumbersAndNamesAreUnique) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kParamCount; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(kParamTable[i].id), i + 1) << kParamTable[i].name;
    EXPECT_TRUE(names.insert(kParamTable[i].name).second) << kParamTable[i].name;
  }
}

TEST(ParamTable, EveryRowIsFoundByItsIdAndByItsName) {
  for (const ParamRow& row : kParamTable) {
    EXPECT_EQ(find_param(static_cast<std::uint16_t>(row.id)), &row);
    EXPECT_EQ(find_param(row.name), &row);
    EXPECT_EQ(&param_row(row.id), &row);
  }
}

TEST(ParamTable, IdsAndNamesItDoesNotHaveAreNotFound) {
  EXPECT_EQ(find_param(std::uint16_t{0}), nullptr);
  EXPECT_EQ(find_param(static_cast<std::uint16_t>(kParamCount + 1)), nullptr);
  EXPECT_EQ(find_param(std::uint16_t{0xFFFF}), nullptr);
  EXPECT_EQ(find_param("no_such_parameter"), nullptr);
  EXPECT_EQ(find_param("c_"), nullptr);
  EXPECT_EQ(find_param(""), nullptr);
}

TEST(ParamTable, EveryRowSaysWhatItIsAndFitsTheMessagesThatCarryIt) {
  for (const ParamRow& row : kParamTable) {
    SCOPED_TRACE(std::string(row.name));
    EXPECT_FALSE(row.name.empty());
    EXPECT_LE(row.name.size(), kParamNameMax);
    EXPECT_LE(row.unit.size(), kParamUnitMax);
    EXPECT_EQ(row.unit.empty(), row.kind == ParamKind::text) << "numbers have a unit, 1 if need be";
    EXPECT_GE(row.doc.size(), 10U);
    EXPECT_LE(row.doc.size(), kParamDocMax);
  }
}

TEST(ParamTable, DefaultsLieWithinTheirLimits) {
  for (const ParamRow& row : kParamTable) {
    SCOPED_TRACE(std::string(row.name));
    EXPECT_LT(row.minimum_raw, row.maximum_raw);
    if (row.kind == ParamKind::text) {
      EXPECT_GE(row.default_text.size(), static_cast<std::size_t>(row.minimum_raw));
      EXPECT_LE(row.default_text.size(), static_cast<std::size_t>(row.maximum_raw));
      EXPECT_LE(static_cast<std::size_t>(row.maximum_raw), ParamText::kCapacity);
    } else {
      EXPECT_GE(row.default_raw, row.minimum_raw);
      EXPECT_LE(row.default_raw, row.maximum_raw);
    }
  }
}

TEST(ParamTable, ExponentsBelongToTheirKind) {
  for (const ParamRow& row : kParamTable) {
    SCOPED_TRACE(std::string(row.name));
    if (row.kind == ParamKind::binary_scaled || row.kind == ParamKind::decimal_scaled) {
      EXPECT_LT(row.exponent, 0);
    } else {
      EXPECT_EQ(row.exponent, 0);
    }
  }
}

TEST(ParamTable, ScalesAreExact) {
  EXPECT_EQ(param_row(Param::c_R).default_raw, 1 << 30);
  EXPECT_EQ(param_row(Param::c_L).minimum_raw, 1 << 29);
  EXPECT_EQ(param_row(Param::c_L).maximum_raw, 3 << 29);
  EXPECT_EQ(param_row(Param::b).default_raw, 290'000'000);  // 0.29 is no double: rounding, not cutting
  EXPECT_EQ(param_row(Param::b).maximum_raw, 2'000'000'000);
  EXPECT_EQ(param_row(Param::wheel_diameter).default_raw, 72'000'000);
  EXPECT_EQ(param_row(Param::speed_limit).default_raw, 750'000);
  EXPECT_EQ(param_row(Param::motor_voltage_max).default_raw, 12'000);
  EXPECT_EQ(param_row(Param::observer_bandwidth).default_raw, 200 << 16);
  EXPECT_EQ(param_row(Param::gear_numerator).default_raw, 438);
  EXPECT_EQ(param_row(Param::motor_polarity_left).minimum_raw, -1);
}

TEST(ParamTable, MakersRoundToTheNearestStepOnBothSidesOfZero) {
  constexpr ParamRow row = decimal_row(Param::b, "b", "m", 3, {0.0014, -0.0016, 0.0016}, "");
  EXPECT_EQ(row.default_raw, 1);
  EXPECT_EQ(row.minimum_raw, -2);
  EXPECT_EQ(row.maximum_raw, 2);
  constexpr ParamRow ends = integer_row(Param::b, "b", "m", {0, -2147483648.0, 2147483647.0}, "");
  EXPECT_EQ(ends.minimum_raw, INT32_MIN);
  EXPECT_EQ(ends.maximum_raw, INT32_MAX);
}

// What people's scripts, older hosts and stored calibrations rely on, once more and literally: a changed
// default, limit, unit or scale is a decision and not a slip of the pen. Numbers in the row's unit.
TEST(ParamTable, StandsAsItWasPublished) {
  struct Published {
    std::string_view name, unit;
    ParamKind kind;
    int exponent;
    double standard, minimum, maximum;
  };
  // clang-format off
  constexpr Published kPublished[] = {
    {"c_R", "1", ParamKind::binary_scaled, -30, 1, 0.5, 1.5},
    {"c_L", "1", ParamKind::binary_scaled, -30, 1, 0.5, 1.5},
    {"b", "m", ParamKind::decimal_scaled, -9, 0.29, 0.05, 2},
    {"wheel_diameter", "m", ParamKind::decimal_scaled, -9, 0.072, 0.01, 1},
    {"counts_per_motor_rev", "count", ParamKind::integer, 0, 64, 1, 65536},
    {"gear_numerator", "1", ParamKind::integer, 0, 438, 1, 1000000},
    {"gear_denominator", "1", ParamKind::integer, 0, 10, 1, 1000000},
    {"motor_polarity_left", "1", ParamKind::integer, 0, 1, -1, 1},
    {"motor_polarity_right", "1", ParamKind::integer, 0, 1, -1, 1},
    {"encoder_polarity_left", "1", ParamKind::integer, 0, 1, -1, 1},
    {"encoder_polarity_right", "1", ParamKind::integer, 0, 1, -1, 1},
    {"kp", "Vs/m", ParamKind::binary_scaled, -16, 60, 0, 1000},
    {"ki", "V/m", ParamKind::binary_scaled, -16, 1200, 0, 30000},
    {"kS_left", "V", ParamKind::binary_scaled, -16, 0.5, 0, 50},
    {"kV_left", "Vs/m", ParamKind::binary_scaled, -16, 12.2, 0, 1000},
    {"kA_left", "Vs^2/m", ParamKind::binary_scaled, -16, 1.1, 0, 100},
    {"observer_bandwidth", "rad/s", ParamKind::binary_scaled, -16, 200, 1, 500},
    {"path_k_along", "1/s", ParamKind::binary_scaled, -16, 8, 0, 1000},
    {"path_k_cross", "1/m^2", ParamKind::binary_scaled, -16, 60, 0, 10000},
    {"path_k_heading", "1/s", ParamKind::binary_scaled, -16, 10, 0, 10000},
    {"speed_limit", "m/s", ParamKind::decimal_scaled, -6, 0.75, 0.01, 10},
    {"yaw_rate_limit", "rad/s", ParamKind::decimal_scaled, -6, 2, 0.01, 50},
    {"acceleration_limit", "m/s^2", ParamKind::decimal_scaled, -6, 0.5, 0.01, 50},
    {"yaw_acceleration_limit", "rad/s^2", ParamKind::decimal_scaled, -6, 3, 0.01, 500},
    {"command_timeout", "ms", ParamKind::integer, 0, 200, 0, 60000},
    {"telemetry_period", "ms", ParamKind::integer, 0, 10, 0, 60000},
    {"motor_voltage_max", "V", ParamKind::decimal_scaled, -3, 12, 1, 50},
    {"battery_low", "mV", ParamKind::integer, 0, 10500, 0, 60000},
    {"battery_high", "mV", ParamKind::integer, 0, 14000, 0, 60000},
    {"over_speed", "m/s", ParamKind::decimal_scaled, -6, 1.2, 0.02, 20},
    {"robot_name", "", ParamKind::text, 0, 0, 1, 24},
    {"kS_right", "V", ParamKind::binary_scaled, -16, 0.5, 0, 50},
    {"kV_right", "Vs/m", ParamKind::binary_scaled, -16, 12.2, 0, 1000},
    {"kA_right", "Vs^2/m", ParamKind::binary_scaled, -16, 1.1, 0, 100},
    {"k_sync", "1/s", ParamKind::binary_scaled, -16, 6, 0, 400},
    {"jerk_limit", "m/s^3", ParamKind::decimal_scaled, -3, 20, 0, 1000},
    {"yaw_jerk_limit", "rad/s^3", ParamKind::decimal_scaled, -3, 120, 0, 10000},
    {"stall_time", "ms", ParamKind::integer, 0, 300, 50, 5000},
    {"e", "1", ParamKind::binary_scaled, -30, 0, -0.2, 0.2},
    {"kappa0", "1/b", ParamKind::decimal_scaled, -6, 0.12, 0.01, 10},
    {"gyro_axis", "1", ParamKind::integer, 0, 0, -3, 3},
    {"gyro_scale", "1", ParamKind::binary_scaled, -30, 1, 0.5, 1.5},
    {"gyro_lag", "s", ParamKind::decimal_scaled, -3, 0.005, 0, 0.25},
    {"gyro_slip_stops", "1", ParamKind::integer, 0, 0, 0, 1},
  };
  // clang-format on
  ASSERT_EQ(kParamTable.size(), std::size(kPublished));
  for (std::size_t i = 0; i < kParamTable.size(); ++i) {
    const ParamRow& row = kParamTable[i];
    const Published& published = kPublished[i];
    SCOPED_TRACE(published.name);
    EXPECT_EQ(row.name, published.name);
    EXPECT_EQ(row.unit, published.unit);
    EXPECT_EQ(row.kind, published.kind);
    EXPECT_EQ(row.exponent, published.exponent);
    const double scale = std::pow(row.kind == ParamKind::binary_scaled ? 2.0 : 10.0, published.exponent);
    EXPECT_EQ(row.default_raw, std::llround(published.standard / scale));
    EXPECT_EQ(row.minimum_raw, std::llround(published.minimum / scale));
    EXPECT_EQ(row.maximum_raw, std::llround(published.maximum / scale));
  }
  EXPECT_EQ(param_row(Param::robot_name).default_text, "ASTRO");
}

TEST(ParamTable, DescribesTheReferenceRobot) {
  const auto value = [](Param id) {
    const ParamRow& row = param_row(id);
    const double base = row.kind == ParamKind::binary_scaled ? 2.0 : 10.0;
    return row.default_raw * std::pow(base, row.exponent);
  };
  // 64 edges per motor revolution, gear 43.8 : 1.
  EXPECT_DOUBLE_EQ(
      value(Param::counts_per_motor_rev) * value(Param::gear_numerator) / value(Param::gear_denominator),
      2803.2);
  // 12 V over the no-load speed of 251 rpm, less the dead zone: the feed-forward reaches full speed near 12
  // V.
  const double no_load_mps = 251.0 / 60 * M_PI * value(Param::wheel_diameter);
  EXPECT_NEAR(value(Param::kS_left) + value(Param::kV_left) * no_load_mps, 12.0, 0.5);
}

}  // namespace
}  // namespace astro
