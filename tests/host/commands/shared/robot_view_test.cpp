#include "host/commands/shared/robot_view.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/base/text/numbers.hpp"

namespace astro::commands {
namespace {

TEST(WithoutMinusZero, ShowsNoSignBeforeNothingButZeros) {
  EXPECT_EQ(in_words({-4e-5, -0.0, -8e-6}), "x   0.0000 m   y   0.0000 m   heading     0.000 deg");
  EXPECT_EQ(in_words({-6e-5, -5.01e-5, -1e-5}), "x  -0.0001 m   y  -0.0001 m   heading    -0.001 deg");
  EXPECT_EQ(in_short_words({-4e-4, -0.0, -8e-4}), "x   0.000 m  y   0.000 m      0.0 deg");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(without_minus_zero(-kInfinity, 3), -kInfinity);
  EXPECT_TRUE(std::isnan(without_minus_zero(std::nan(""), 3)));
  // Nobody needs to know which way a tie is rounded: what is printed decides.
  for (const double value : {-0.5, -0.05, -0.0005, -0.25, -0.00049999}) {
    for (const int decimals : {0, 1, 2, 3}) {
      const std::string shown = fmt::format("{:.{}f}", without_minus_zero(value, decimals), decimals);
      EXPECT_EQ(shown.starts_with('-'), shown.find_first_of("123456789") != std::string::npos) << shown;
    }
  }
}

TEST(Durations, AreInUnitsThatPeopleUse) {
  EXPECT_EQ(duration_in_words(0), "0.0 s");
  EXPECT_EQ(duration_in_words(59'900'000), "59.9 s");
  EXPECT_EQ(duration_in_words(61'000'000), "1 min 01 s");
  EXPECT_EQ(duration_in_words(7'384'000'000), "2 h 03 min 04 s");
}

TEST(FaultHelp, SaysSomethingAboutEveryFault) {
  for (std::size_t i = 1; i < kFaultNames.size(); ++i)
    EXPECT_GT(fault_help(static_cast<Fault>(i)).size(), 20U) << kFaultNames[i];
  EXPECT_EQ(fault_help(static_cast<Fault>(200)), "");
}

}  // namespace
}  // namespace astro::commands
