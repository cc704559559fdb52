#include "common/params/parameter_set.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "tests/common/params/random_set.hpp"

namespace astro {
namespace {

/// The row that validate() names, `none` if it accepts.
Param verdict(const ParameterSet& set) {
  const auto result = validate(set);
  return result ? Param::none : result.error();
}

Param verdict_with(Param id, std::int32_t raw) {
  ParameterSet set;
  set.set(id, raw);
  return verdict(set);
}

TEST(ParameterSet, HoldsTheDefaultsUntilToldOtherwise) {
  const ParameterSet set = ParameterSet::defaults();
  for (const ParamRow& row : kParamTable) {
    if (row.kind == ParamKind::text) {
      EXPECT_EQ(set.text(row.id).view(), row.default_text);
    } else {
      EXPECT_EQ(set.get(row.id), row.default_raw) << row.name;
    }
  }
  EXPECT_TRUE(validate(set));
}

TEST(ParameterSet, SettingOneRowChangesThatRowAlone) {
  for (const ParamRow& changed : kParamTable) {
    ParameterSet set;
    if (changed.kind == ParamKind::text) {
      set.set_text(changed.id, "another");
      EXPECT_EQ(set.text(changed.id).view(), "another");
    } else {
      set.set(changed.id, -12345);
      EXPECT_EQ(set.get(changed.id), -12345);
    }
    EXPECT_NE(set, ParameterSet::defaults());
    for (const ParamRow& row : kParamTable) {
      if (row.id != changed.id && row.kind != ParamKind::text) {
        EXPECT_EQ(set.get(row.id), row.default_raw) << changed.name << " changed " << row.name;
      }
    }
  }
}

TEST(Validation, NamesTheOneRowThatIsOutsideItsLimits) {
  for (const ParamRow& row : kParamTable) {
    if (row.kind == ParamKind::text) continue;
    EXPECT_EQ(verdict_with(row.id, row.minimum_raw - 1), row.id) << row.name;
    EXPECT_EQ(verdict_with(row.id, row.maximum_raw + 1), row.id) << row.name;
    EXPECT_EQ(verdict_with(row.id, INT32_MIN), row.id) << row.name;
    EXPECT_EQ(verdict_with(row.id, INT32_MAX), row.id) << row.name;
  }
}

TEST(Validation, NeverBlamesARowForItsLimitsWhenItStandsOnThem) {
  for (const ParamRow& row : kParamTable) {
    if (row.kind == ParamKind::text) continue;
    for (const std::int32_t raw : {row.minimum_raw, row.maximum_raw}) {
      // The only single limits that break a rule between rows.
      const bool rule = (row.id == Param::speed_limit && raw == row.maximum_raw) ||
                        (row.id == Param::over_speed && raw == row.minimum_raw) ||
                        (row.id == Param::battery_low && raw == row.maximum_raw) ||
                        (row.id == Param::gear_denominator && raw == row.maximum_raw);
      EXPECT_EQ(verdict_with(row.id, raw) == Param::none, !rule) << row.name << " = " << raw;
    }
  }
}

TEST(Validation, NamesTheFirstOfSeveralBadRows) {
  ParameterSet set;
  set.set(Param::kp, -1);
  set.set(Param::b, 0);
  set.set(Param::over_speed, 0);
  EXPECT_EQ(verdict(set), Param::b);
}

TEST(Validation, RefusesAPolarityOfZero) {
  for (const Param id : {Param::motor_polarity_left, Param::motor_polarity_right,
                         Param::encoder_polarity_left, Param::encoder_polarity_right}) {
    EXPECT_EQ(verdict_with(id, 0), id);
    EXPECT_EQ(verdict_with(id, -1), Param::none);
  }
}

TEST(Validation, WantsTheBatteryLimitsInOrderUnlessOneIsOff) {
  EXPECT_EQ(verdict_with(Param::battery_low, 14'000), Param::battery_high);
  EXPECT_EQ(verdict_with(Param::battery_low, 13'999), Param::none);
  EXPECT_EQ(verdict_with(Param::battery_high, 10'499), Param::battery_high);
  EXPECT_EQ(verdict_with(Param::battery_high, 0), Param::none);
  EXPECT_EQ(verdict_with(Param::battery_low, 0), Param::none);
}

TEST(Validation, ABatteryLimitOfAMillivoltIsALimit) {
  ParameterSet set;
  set.set(Param::battery_low, 1);
  set.set(Param::battery_high, 1);
  EXPECT_EQ(verdict(set), Param::battery_high);
  set.set(Param::battery_high, 2);
  EXPECT_EQ(verdict(set), Param::none);
  set.set(Param::battery_high, 0);
  EXPECT_EQ(verdict(set), Param::none) << "off";
}

TEST(ParameterSet, OnlyGainsMayDifferWhereOnlyGainsMay) {
  const std::set<Param> gains{Param::kp,
                              Param::ki,
                              Param::kS_left,
                              Param::kV_left,
                              Param::kA_left,
                              Param::kS_right,
                              Param::kV_right,
                              Param::kA_right,
                              Param::k_sync,
                              Param::path_k_along,
                              Param::path_k_cross,
                              Param::path_k_heading,
                              Param::observer_bandwidth};
  EXPECT_TRUE(only_gains_differ({}, {}));
  for (const ParamRow& row : kParamTable) {
    ParameterSet other;
    if (row.kind == ParamKind::text) {
      other.set_text(row.id, "another");
    } else {
      other.set(row.id, row.default_raw + 1);
    }
    EXPECT_EQ(only_gains_differ({}, other), gains.contains(row.id)) << row.name;
    EXPECT_EQ(only_gains_differ(other, {}), gains.contains(row.id)) << row.name;
  }
}

TEST(Validation, WantsOverSpeedAboveTheSpeedLimit) {
  EXPECT_EQ(verdict_with(Param::speed_limit, 1'200'000), Param::over_speed);
  EXPECT_EQ(verdict_with(Param::speed_limit, 1'199'999), Param::none);
}

TEST(Validation, WantsANameOfPrintableAscii) {
  const auto named = [](std::string_view name) {
    ParameterSet set;
    set.set_text(Param::robot_name, ParamText(name));
    return verdict(set);
  };
  EXPECT_EQ(named("Robot 7 ~"), Param::none);
  EXPECT_EQ(named(std::string(24, 'x')), Param::none);
  EXPECT_EQ(named(""), Param::robot_name);
  EXPECT_EQ(named("tab\there"), Param::robot_name);
  EXPECT_EQ(named("del\x7f"), Param::robot_name);
  EXPECT_EQ(named("\xC5\xBDuti"), Param::robot_name);
}

/// The greatest travel per count in metres, in long double from the raw values.
long double travel_m(const ParameterSet& set, Param correction) {
  return 3.14159265358979323846L * set.get(Param::wheel_diameter) * 1e-9L * set.get(correction) / (1 << 30) *
         set.get(Param::gear_denominator) / set.get(Param::gear_numerator) /
         set.get(Param::counts_per_motor_rev);
}

TEST(Validation, AcceptsTravelPerCountUpToAnEighthOfAMetre) {
  ParameterSet set;
  set.set(Param::b, 2'000'000'000);
  set.set(Param::counts_per_motor_rev, 1);
  set.set(Param::gear_numerator, 1);
  set.set(Param::gear_denominator, 1);
  set.set(Param::wheel_diameter, 39'788'000);  // pi D = 0.1249977 m
  EXPECT_EQ(verdict(set), Param::none);
  set.set(Param::wheel_diameter, 39'789'000);  // 0.1250009 m
  EXPECT_EQ(verdict(set), Param::counts_per_motor_rev);
  set.set(Param::wheel_diameter, 39'788'000);
  set.set(Param::c_L, (1 << 30) + (1 << 15));  // one wheel is enough: 0.1250015 m
  EXPECT_EQ(verdict(set), Param::counts_per_motor_rev);
}

TEST(Validation, RefusesTravelPerCountThatDrownsInTheResolution) {
  ParameterSet set;
  set.set(Param::counts_per_motor_rev, 65536);
  set.set(Param::gear_numerator, 1'000'000);
  set.set(Param::gear_denominator, 1000);  // 3.45 nm
  EXPECT_EQ(verdict(set), Param::none);
  set.set(Param::gear_denominator, 100);  // 0.345 nm
  EXPECT_EQ(verdict(set), Param::counts_per_motor_rev);
}

TEST(Validation, RoundsAWheelToTheNearestNanometre) {
  ParameterSet set;
  // Half of 11,299,999 nm is 113 * 50,000 nm less half a nanometre: 355 / 113 of that is 355 * 50,000 nm, and
  // so one nanometre a count, the least that is accepted.
  set.set(Param::c_L, 1 << 29);
  set.set(Param::c_R, 1 << 29);
  set.set(Param::wheel_diameter, 11'299'999);
  set.set(Param::counts_per_motor_rev, 50);
  set.set(Param::gear_numerator, 355'000);
  set.set(Param::gear_denominator, 1);
  EXPECT_EQ(verdict(set), Param::none);
  set.set(Param::wheel_diameter, 11'299'998);
  EXPECT_EQ(verdict(set), Param::counts_per_motor_rev);
  // Three quarters of 15,066,967 nm are 113 * 100,002 nm less three quarters: a nanometre short.
  set.set(Param::c_L, 3 << 28);
  set.set(Param::c_R, 3 << 28);
  set.set(Param::wheel_diameter, 15'066'967);
  set.set(Param::counts_per_motor_rev, 71);
  set.set(Param::gear_numerator, 500'010);
  EXPECT_EQ(verdict(set), Param::counts_per_motor_rev);
  set.set(Param::wheel_diameter, 15'066'968);
  EXPECT_EQ(verdict(set), Param::none);
}

/// One count is a turn of a wheel of 30 mm: 8 of them are pi * 0.24 m.
ParameterSet with_a_count_of_a_turn() {
  ParameterSet set;
  set.set(Param::counts_per_motor_rev, 1);
  set.set(Param::gear_numerator, 1);
  set.set(Param::gear_denominator, 1);
  set.set(Param::wheel_diameter, 30'000'000);
  return set;
}

TEST(Validation, RefusesAWheelbaseThatTurnsASixteenthPerCount) {
  ParameterSet set = with_a_count_of_a_turn();
  set.set(Param::b, 240'001'000);
  EXPECT_EQ(verdict(set), Param::none);
  set.set(Param::b, 239'999'000);
  EXPECT_EQ(verdict(set), Param::b);
}

TEST(Validation, RefusesAWheelbaseOfCurvesThatTurnsASixteenthPerCount) {
  ParameterSet set = with_a_count_of_a_turn();
  set.set(Param::e, -(1 << 30) / 5);
  set.set(Param::b, 300'002'000);  // 0.8 b = 0.24 m
  EXPECT_EQ(verdict(set), Param::none);
  set.set(Param::b, 299'998'000);
  EXPECT_EQ(verdict(set), Param::b);
  set.set(Param::e, (1 << 30) / 5);
  set.set(Param::b, 239'999'000);
  EXPECT_EQ(verdict(set), Param::b) << "spins still turn about b";
}

/// Holds the integer arithmetic of the geometry rules against long double over the whole range of every row,
/// so an overflow would show. 1e-6 is more than pi's 355/113 (1e-7) and the nanometre steps near 0.125 m are
/// off.
RC_GTEST_PROP(Validation, JudgesGeometryAsRealArithmeticDoes, ()) {
  const auto within = [](Param id) {
    const ParamRow& row = param_row(id);
    return *rc::gen::resize(rc::kNominalSize,
                            rc::gen::inRange<std::int64_t>(row.minimum_raw, row.maximum_raw + 1LL));
  };
  ParameterSet set;
  for (const Param id : {Param::c_R, Param::c_L, Param::b, Param::wheel_diameter, Param::e}) {
    set.set(id, static_cast<std::int32_t>(within(id)));
  }
  for (const Param id : {Param::counts_per_motor_rev, Param::gear_numerator, Param::gear_denominator}) {
    // Spread over the orders of magnitude: the rule bites where the first two are small and the last is
    // large.
    const auto shift = *rc::gen::inRange(0, 20);
    set.set(id, static_cast<std::int32_t>(std::max<std::int64_t>(1, within(id) >> shift)));
  }
  const long double right = travel_m(set, Param::c_R);
  const long double left = travel_m(set, Param::c_L);
  const long double longest = std::max(right, left);
  const long double smallest_base_m =
      set.get(Param::b) * 1e-9L *
      (1 + std::min(std::ldexp(static_cast<long double>(set.get(Param::e)), -30), 0.0L));
  const long double turn = longest / smallest_base_m / (2 * 3.14159265358979323846L);
  RC_PRE(std::abs(longest / 0.125L - 1) > 1e-6L && std::abs(turn * 16 - 1) > 1e-6L &&
         std::min(right, left) > 2e-9L);
  const Param expected = longest > 0.125L ? Param::counts_per_motor_rev
                         : turn > 0.0625L ? Param::b
                                          : Param::none;
  RC_TAG(expected == Param::none ? "accepted" : "refused");
  RC_ASSERT(verdict(set) == expected);
}

TEST(Validation, AcceptsSetsFromTheWholeOfItsRange) {
  std::mt19937 random(2024);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(validate(support::random_valid_set(random)));
}

}  // namespace
}  // namespace astro
