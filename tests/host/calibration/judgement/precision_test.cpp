#include "host/calibration/judgement/precision.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "host/base/require_positive.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::calibration {
namespace {

constexpr double kSlip_m = 2.645e-6;
constexpr double kDesignWheelbase_m = 0.290;

TEST(Precision, TenSquaresComeWithinFourPercentOfTheCramerRaoBound) {
  const Precision p =
      reachable_precision({10 * 4 * 3.0, 10 * 2 * std::numbers::pi}, kSlip_m, kDesignWheelbase_m);
  // The bound is printed to three digits: 2.03, 1.05 and 3.92, each times 1e-4.
  EXPECT_NEAR(p.E_d / 2.03e-4, 1, 0.04);
  EXPECT_NEAR(p.scale / 1.05e-4, 1, 0.04);
  EXPECT_NEAR(p.b / 3.92e-4, 1, 0.04);
}

TEST(Precision, FourTimesTheDriveHalvesTheError) {
  const Precision short_drive = reachable_precision({30, 20}, kSlip_m, kDesignWheelbase_m);
  const Precision long_drive = reachable_precision({120, 80}, kSlip_m, kDesignWheelbase_m);
  EXPECT_DOUBLE_EQ(long_drive.E_d, short_drive.E_d / 2);
  EXPECT_DOUBLE_EQ(long_drive.scale, short_drive.scale / 2);
  EXPECT_DOUBLE_EQ(long_drive.b, short_drive.b / 2);
}

TEST(Precision, RefusesWhatIsNoDrive) {
  using support::ThrowsTelling;
  EXPECT_THAT(([] {
                reachable_precision({std::nan(""), 10}, kSlip_m, kDesignWheelbase_m);
              }),
              ThrowsTelling(SettingProblem::not_positive, "the distance in metres", "nan"));
  EXPECT_THAT(([] {
                reachable_precision({10, 0}, kSlip_m, kDesignWheelbase_m);
              }),
              ThrowsTelling(SettingProblem::not_positive, "the rotation in radians", "0"));
}

}  // namespace
}  // namespace astro::calibration
