#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>

#include "tests/support/base/thorough.hpp"
#include "tests/target/ros2/node_at_usb.hpp"

namespace astro::ros2 {
namespace {

// By its own time-out of 0.2 s and a ramp from at most 0.3 m/s at 0.5 m/s^2.
constexpr int kStops_ms = 200 + 600 + 100;

using UsbCable = NodeAtUsb;

TEST_F(UsbCable, PullsWhileItDrivesEachStopTheRobotAndEachIsRecoveredWithoutAJump) {
  constexpr unsigned kSeed = 20261124;
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> before_ms(50, 400);
  std::uniform_real_distribution<double> v_mps(-0.3, 0.3), omega_radps(-0.8, 0.8);
  const auto said_something = [&] { return !odometry().empty(); };
  ASSERT_TRUE(run_until(said_something, 3000)) << why_silent();
  double worst_m = 0;
  const int pulls = support::how_often(20, 100);
  for (int i = 0; i < pulls; ++i) {
    ASSERT_TRUE(run_until([&] { return arm(); }, 2000)) << i;
    const double v = v_mps(random), omega = omega_radps(random);
    drive_ms(before_ms(random), v, omega);
    ASSERT_FALSE(outputs_off()) << i;
    cable().unplug();
    drive_ms(50, v, omega);
    odometry();                     // what had come before
    drive_ms(kStops_ms, v, omega);  // others go on commanding
    ASSERT_TRUE(outputs_off()) << i;
    ASSERT_TRUE(odometry().empty()) << i << ": nothing is known";
    cable().plug_in();
    std::vector<msg::Odometry> after;
    ASSERT_TRUE(run_until([&] { return !(after = odometry()).empty(); }, 3000)) << i;
    worst_m = std::max(worst_m, off_m(after.front()));
    drive_ms(100, 0.3, 0);
    ASSERT_TRUE(outputs_off()) << i << ": nobody has armed it again";
  }
  std::printf(
      "%d pulls of an emulated USB cable, seed %u: all stopped, all recovered; odometry at most %.2f mm "
      "off\n",
      pulls, kSeed, 1e3 * worst_m);
  // Without slip odometry is off by the rounding of counts and of the robot's arcs: 0.1 mm a drive.
  EXPECT_LT(worst_m, 0.01);
}

}  // namespace
}  // namespace astro::ros2
