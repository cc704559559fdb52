#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "tests/target/ros2/node_at_usb.hpp"

// Two cables at the image that is flashed: the node at the USB port, another program at the serial port. Whichever of them
// drives and goes on, a halt through the other cable holds.
namespace astro::ros2 {
namespace {

class TwoCables : public NodeAtUsb {
 protected:
  TwoCables() : other_(serial_line()) {
    EXPECT_TRUE(run_until([&] { return !odometry().empty(); }, 3000)) << why_silent();
    other_.connect();
  }

  static constexpr double kSpeed_mps = 0.75;  // the greatest of the default parameters
  /// The ramp from there at 0.5 m/s^2 with 20 m/s^3, and 50 ms.
  static constexpr double kMost_m = kSpeed_mps / 2 * (kSpeed_mps / 0.5 + 0.5 / 20) + 0.05 * kSpeed_mps;

  void node_goes_on(int ms) { drive_ms(ms, kSpeed_mps, 0); }
  void other_goes_on(int ms) {
    for (int i = 0; i < ms; i += 50) {
      try {
        other_.request(protocol::Velocity{750'000, 0});
      } catch (const robot::RobotRefused&) {  // it does not care
      }
      run_ms(50);
    }
  }

  /// Drives for two seconds, halts the robot and drives on; prints how far it came after the halt.
  void expect_halt(const std::string& name, const std::function<void(int)>& drive,
                   const std::function<void()>& halt) {
    drive(2000);
    const sim::Pose before = teensy().world().truth();
    halt();
    drive(3000);
    const sim::Pose after = teensy().world().truth();
    drive(1000);
    const double way_m = std::hypot(after.x_m - before.x_m, after.y_m - before.y_m);
    fmt::print("{}: {:.3f} m (bar {:.3f})\n", name, way_m, kMost_m);
    EXPECT_LE(way_m, kMost_m) << name;
    EXPECT_GT(way_m, 0.1) << name << ": it was not driving";
    EXPECT_NEAR(teensy().world().truth().x_m, after.x_m, 1e-3) << name << ": it drives again";
  }

  robot::Client other_;
};

TEST_F(TwoCables, AHaltThroughTheSerialPortHoldsAgainstTheNodesVelocities) {
  const auto drive = [&](int ms) { node_goes_on(ms); };
  const auto arm_node = [&] {
    call("/clear_faults");
    ASSERT_TRUE(run_until([&] { return arm(); }, 5000)) << why_silent();
  };
  arm_node();
  expect_halt("node drives, Stop at the serial port", drive, [&] { other_.request(protocol::Stop{}); });
  arm_node();
  expect_halt("node drives, Pause at the serial port", drive, [&] { other_.request(protocol::Pause{}); });
  arm_node();
  expect_halt("node drives, Disarm at the serial port", drive, [&] { other_.request(protocol::Disarm{}); });
  arm_node();
  expect_halt("node drives, EmergencyStop at the serial port", drive,
              [&] { other_.request(protocol::EmergencyStop{}); });
}

TEST_F(TwoCables, AHaltThroughTheNodeHoldsAgainstAProgramAtTheSerialPort) {
  const auto drive = [&](int ms) { other_goes_on(ms); };
  for (const char* service : {"/stop", "/pause", "/disarm", "/emergency_stop"}) {
    run_ms(2000);
    other_.request(protocol::ClearFaults{});
    other_.request(protocol::GetStatus{});  // or the robot takes no Arm after the node's stop
    other_.request(protocol::Arm{});
    expect_halt(fmt::format("serial port drives, {} of the node", service), drive,
                [&] { EXPECT_TRUE(call(service)); });
  }
}

}  // namespace
}  // namespace astro::ros2
