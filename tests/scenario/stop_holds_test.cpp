#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "common/protocol/frame.hpp"
#include "host/simulation/robot/virtual_robot.hpp"
#include "tests/support/robots/drive_of.hpp"
#include "tests/support/robots/random.hpp"

// A host at one port drives and never stops asking for motion; another host, at the other port or beside it at the same one,
// halts the robot. Whatever the first one sends, it does not drive again before it arms the robot. `./dev fuzz` tries ten thousand.
namespace astro {
namespace {

using simulation::VirtualRobot;

constexpr int kDriver = 0, kOther = 1;

struct Halt {
  const char* name;
  std::uint8_t message;
  bool ramps;
};
constexpr std::array kHalts{
    Halt{"Stop", protocol::Stop::kId, true}, Halt{"Pause", protocol::Pause::kId, true},
    Halt{"Disarm", protocol::Disarm::kId, false}, Halt{"EmergencyStop", protocol::EmergencyStop::kId, false}};

/// What a ramp from the greatest speed to rest covers: with the acceleration a and the jerk j a speed v takes v / a + a / j,
/// and by symmetry half of v times that.
double way_of_ramp_m(const ParameterSet& set) {
  const double v = 1e-6 * set.get(Param::speed_limit), a = 1e-6 * set.get(Param::acceleration_limit),
               j = 1e-3 * set.get(Param::jerk_limit);
  return v / 2 * (v / a + (j > 0 ? a / j : 0));
}

class TwoPorts {
 public:
  explicit TwoPorts(std::uint64_t seed) : random_(seed), robot_(robot(seed), {}) {
    pass(60);  // through boot
    drives_ = static_cast<int>(random_.between(0, 3));
  }

  /// A drive of some kind, then the halt at a moment of that drive, then four seconds in which the driver goes on.
  void live(const Halt& halt) {
    send(protocol::Arm{}, kDriver);
    const auto before_ms = random_.between(1, 4000);
    for (std::int64_t i = 0; i < before_ms; ++i) step_with_driver();
    moved_at_halt_ = drive().gives_power();
    const int port = random_.chance(0.7) ? kOther : kDriver;
    const std::uint16_t onlooker = port == kDriver ? protocol::kOnlookerBit : 0;
    switch (halt.message) {
      case protocol::Stop::kId:
        send(protocol::Stop{}, port, onlooker);
        break;
      case protocol::Pause::kId:
        send(protocol::Pause{}, port, onlooker);
        break;
      case protocol::Disarm::kId:
        send(protocol::Disarm{}, port, onlooker);
        break;
      default:
        send(protocol::EmergencyStop{}, port, onlooker);
    }
    robot_.step();  // it takes the request
    halted_ = true;
    for (int i = 0; i < 4000; ++i) step_with_driver();
  }

  double way_m() const { return way_m_; }
  int powered_ms() const { return powered_ms_; }
  bool rests() { return std::abs(drive().twist().v_umps) < 3000 && !drive().gives_power(); }
  bool moved_at_halt() const { return moved_at_halt_; }
  const ParameterSet& parameters() const { return robot_.robot().parameters(); }

 private:
  static sim::Config robot(std::uint64_t seed) {
    sim::Config config;
    config.seed = seed;
    return config;
  }
  const Drive& drive() { return support::drive_of(robot_); }

  template <protocol::Message M>
  void send(const M& message, int port, std::uint16_t onlooker = 0) {
    request_ = static_cast<std::uint16_t>(request_ % 0x7FFF + 1);
    robot_.board().ports().host_write(
        port, protocol::Frame(message, static_cast<std::uint16_t>(request_ | onlooker)).bytes());
  }

  /// One millisecond in which the driver may ask for something that moves the robot, but never arms it.
  void step_with_driver() {
    if (--until_request_ms_ <= 0) {
      until_request_ms_ = static_cast<int>(random_.between(1, 50));
      ask_for_motion();
    }
    pass(1);
  }

  void ask_for_motion() {
    if (random_.chance(0.02)) return send(protocol::Rest{}, kDriver);
    if (random_.chance(0.01)) drives_ = static_cast<int>(random_.between(0, 3));  // in another way
    switch (drives_) {
      case 0:
      case 1: {
        const auto v = static_cast<std::int32_t>(random_.between(-750'000, 750'000));
        if (random_.chance(0.01)) velocity_ = v;
        return send(protocol::Velocity{velocity_, 0}, kDriver);
      }
      case 2:
        if (random_.chance(0.1)) return send(protocol::Resume{}, kDriver);
        return send(protocol::AddSegment{.kind = protocol::SegmentKind::line,
                                         .tag = 1,
                                         .length_nm = random_.between(-1'000'000'000, 1'000'000'000)},
                    kDriver);
      default:
        return send(protocol::WheelVoltage{static_cast<std::int32_t>(random_.between(2'000, 8'000)),
                                           static_cast<std::int32_t>(random_.between(2'000, 8'000))},
                    kDriver);
    }
  }

  void pass(int ms) {
    for (int i = 0; i < ms; ++i) {
      const sim::Pose before = robot_.board().truth();
      robot_.step();
      const sim::Pose after = robot_.board().truth();
      if (halted_) way_m_ += std::hypot(after.x_m - before.x_m, after.y_m - before.y_m);
      if (halted_ && robot_.board().motors().state() == sim::Bridge::drive) ++powered_ms_;
      for (const int port : {kDriver, kOther}) {
        std::array<std::uint8_t, 512> dropped{};
        while (robot_.board().ports().host_read(port, dropped) == dropped.size()) {
        }
      }
    }
  }

  support::Random random_;
  VirtualRobot robot_;
  std::uint16_t request_ = 0;
  int drives_ = 0, until_request_ms_ = 0;
  std::int32_t velocity_ = 750'000;
  bool halted_ = false, moved_at_halt_ = false;
  double way_m_ = 0;
  int powered_ms_ = 0;
};

TEST(StopHolds, WhoeverDrivesOnAtTheOtherPort) {
  const std::uint64_t count = support::number_from("ASTROLABE_STOPS", 200);
  const std::uint64_t first = support::number_from("ASTROLABE_STOPS_SEED", 20'261'125);
  std::array<double, kHalts.size()> longest_m{};
  int moved = 0;
  double most_m = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    SCOPED_TRACE(fmt::format("ASTROLABE_STOPS=1 ASTROLABE_STOPS_SEED={} repeats it", seed));
    const std::size_t kind = seed % kHalts.size();
    TwoPorts robot(seed);
    robot.live(kHalts[kind]);
    // 50 ms at the greatest speed: 1 ms until the request is taken, the lag of the speed loop, which is some 20 ms, and
    // the slip of the wheels.
    most_m = way_of_ramp_m(robot.parameters()) + 0.05 * 1e-6 * robot.parameters().get(Param::speed_limit);
    EXPECT_LE(robot.way_m(), most_m) << kHalts[kind].name;
    EXPECT_TRUE(robot.rests()) << kHalts[kind].name;
    EXPECT_TRUE(kHalts[kind].ramps || robot.powered_ms() == 0) << kHalts[kind].name;
    longest_m[kind] = std::max(longest_m[kind], robot.way_m());
    moved += robot.moved_at_halt() ? 1 : 0;
    if (testing::Test::HasFailure()) return;
  }
  for (std::size_t i = 0; i < kHalts.size(); ++i)
    fmt::print("{}: at most {:.3f} m (bar {:.3f})\n", kHalts[i].name, longest_m[i], most_m);
  fmt::print("{} halts from seed {}, {} of them while the robot moved\n", count, first, moved);
  EXPECT_TRUE(count < 200 || moved > static_cast<int>(count) / 2);
}

}  // namespace
}  // namespace astro
