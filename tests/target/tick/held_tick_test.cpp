#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "common/params/table.hpp"
#include "host/emulator/robot/emulated_robot.hpp"
#include "host/emulator/robot/teensy.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/motion/paths.hpp"
#include "tests/target/firmware_file.hpp"

// While the main loop holds the tick no byte of the UART is taken either: it overruns after 40 us, which are
// 24,000 instructions. The bar leaves the tick itself within a microsecond of its time.

namespace astro::target {

namespace {

/// Instructions that the main loop spends in one go while it holds the control tick: with BASEPRI raised, as
/// hold_tick() does. Not counted is the flash driver, which switches all interrupts off for the 71 us in
/// which a page goes over the wire: the firmware writes flash only at rest.
class HeldTick {
 public:
  explicit HeldTick(emulator::Teensy& teensy) : cpu_(teensy.chip().cpu()) {
    cpu_.trace = [this](std::uint32_t, std::uint32_t instructions) { look(instructions); };
  }
  ~HeldTick() { cpu_.trace = nullptr; }
  HeldTick(const HeldTick&) = delete;
  HeldTick& operator=(const HeldTick&) = delete;

  /// The longest since the last call.
  std::uint32_t take_longest() { return std::exchange(longest_, 0); }
  /// How often the tick was held since construction.
  std::uint64_t holds() const { return holds_; }

 private:
  static constexpr std::uint32_t kTickPriority = 2U << 4;  // urgency::kTick as BASEPRI holds it

  void look(std::uint32_t instructions) {
    if ((cpu_.get(UC_ARM_REG_IPSR) & 0x1FF) != 0) return;
    const std::uint32_t base = cpu_.get(UC_ARM_REG_BASEPRI);
    const bool held = base != 0 && base <= kTickPriority;
    if (held) {
      holds_ += now_ == 0 ? 1 : 0;
      now_ += instructions;
      longest_ = std::max(longest_, now_);
    } else {
      now_ = 0;
    }
  }

  emulator::Cpu& cpu_;
  std::uint32_t now_ = 0, longest_ = 0;
  std::uint64_t holds_ = 0;
};

using namespace std::chrono_literals;
using emulator::EmulatedRobot;

constexpr std::uint32_t kBar = 500;

class TickHeld : public testing::Test {
 protected:
  void SetUp() override {
    client_.connect();
    client_.pump(100ms);
    held_.take_longest();
  }

  /// Sends it, lets the main loop go round a few times, and notes how long the tick was held at most.
  template <protocol::Request M>
  void ask(const M& message, const std::string& when) {
    const std::string name = std::string(M::kName) + ", " + when;
    try {
      client_.request(message);
    } catch (const robot::RobotRefused& refused) {
      if (!may_refuse_) ADD_FAILURE() << name << ": " << refused.what();
    }
    client_.pump(5ms);
    note(name);
  }
  void pump(std::chrono::microseconds time, const std::string& when) {
    client_.pump(time);
    note(when);
  }
  void note(const std::string& name) {
    const std::uint32_t longest = held_.take_longest();
    worst_[name] = std::max(worst_[name], longest);
    EXPECT_LE(longest, kBar) << name;
  }
  /// All that does not move the robot and may be asked at any time.
  void ask_whatever(const std::string& when) {
    ask(protocol::Ping{}, when);
    ask(protocol::GetStatus{}, when);
    ask(protocol::GetFaults{}, when);
    ask(protocol::GetParameterInfo{3}, when);
    ask(protocol::GetParameter{3}, when);
    ask(protocol::RevertParameters{}, when);
    stage(Param::kp, 40 << 16, when);
    stage(Param::observer_bandwidth, 150 << 16, when);
    ask(protocol::ApplyParameters{}, when);
    stage(Param::kp, 50 << 16, when);
    ask(protocol::ApplyParameters{}, when);
    ask(protocol::SetTelemetry{2, protocol::Telemetry::kAll}, when);
    ask(protocol::SetTelemetry{0, 0}, when);
    may_refuse_ = true;
    ask(protocol::GetFaultLog{0}, when);
    ask(protocol::CommitParameters{}, when);
    ask(protocol::SetPose{1, 2, 3}, when);
    ask(protocol::ClearFaults{}, when);
    may_refuse_ = false;
  }
  void stage(Param param, std::int32_t raw, const std::string& when) {
    ask(protocol::StageParameter{static_cast<std::uint16_t>(param), raw, {}}, when);
  }

  void expect_short_holds(std::int32_t e_30);

  std::shared_ptr<EmulatedRobot> robot_ =
      std::make_shared<EmulatedRobot>(kImage, sim::Config{}, simulation::MocapConfig{});
  HeldTick held_{robot_->teensy()};
  robot::Client client_{std::make_unique<emulator::PortTransport>(robot_, emulator::Port::serial)};
  bool may_refuse_ = false;
  std::map<std::string, std::uint32_t> worst_;
};

void TickHeld::expect_short_holds(std::int32_t e_30) {
  robot_->teensy().flash().times = {50 * emulator::kCyclesPerMicrosecond,
                                    500 * emulator::kCyclesPerMicrosecond};
  ask_whatever("disarmed");
  ask(protocol::DefaultParameters{}, "disarmed");
  stage(Param::b, 291'000'000, "disarmed");
  stage(Param::jerk_limit, 15'000, "disarmed");
  stage(Param::e, e_30, "disarmed");
  ask(protocol::CommitParameters{}, "disarmed");

  ask(protocol::Arm{}, "disarmed");
  ask_whatever("armed");
  ask(protocol::Velocity{200'000, 100'000}, "armed");
  for (const std::int32_t turn : {300'000, -200'000, 3'000'000, 0}) {
    ask(protocol::Velocity{400'000, turn}, "velocity");
    ask_whatever("velocity");
  }
  ask(protocol::Stop{}, "velocity");
  ask_whatever("stopping");
  pump(2s, "stopping");

  ask(protocol::Arm{}, "armed");
  ask(protocol::Velocity{300'000, 100'000}, "armed");
  ask(protocol::Pause{}, "velocity");
  pump(2s, "stopping");
  ask(protocol::Resume{}, "paused");
  for (int i = 0; i < 16; ++i) ask(robot::line(0.2).front(), "path");
  pump(300ms, "path");
  ask_whatever("path");
  ask(protocol::Pause{}, "path");
  pump(1s, "path");
  ask(protocol::Resume{}, "paused");
  pump(200ms, "path");
  ask(protocol::Velocity{100'000, -100'000}, "path");
  ask(protocol::Rest{}, "velocity");
  pump(2s, "stopping");
  for (int i = 0; i < 16; ++i) ask(robot::line(0.2).front(), "path");
  ask(protocol::Stop{}, "path");
  pump(2s, "stopping");
  ask(protocol::Arm{}, "armed");
  for (int i = 0; i < 16; ++i) ask(robot::line(0.2).front(), "path");
  ask(protocol::Disarm{}, "path");
  ask(protocol::Arm{}, "disarmed");
  ask(protocol::WheelVoltage{500, 500}, "armed");
  ask(protocol::WheelVoltage{1500, -1500}, "wheels");
  ask_whatever("wheels");
  ask(protocol::EmergencyStop{}, "wheels");
  pump(2s, "fault");
  ask_whatever("fault");
  ask(protocol::GetFaultLog{0}, "fault");
  ask(protocol::Reboot{}, "disarmed");

  std::multimap<std::uint32_t, std::string, std::greater<>> sorted;
  for (const auto& [name, longest] : worst_) sorted.emplace(longest, name);
  fmt::print("longest section with the tick held, instructions (bar {})\n", kBar);
  for (int shown = 0; const auto& [longest, name] : sorted)
    if (shown++ < 10) fmt::print("  {:>6}  {}\n", longest, name);
  EXPECT_GT(held_.holds(), 1000U) << "the sections were not found";
  EXPECT_GT(sorted.begin()->first, 20U);
}

TEST_F(TickHeld, ByAnyRequestIsHeldForAtMost500Instructions) { expect_short_holds(0); }

TEST_F(TickHeld, WithACurvatureEffectIsHeldForAtMost500InstructionsToo) {
  expect_short_holds(32'212'255);  // 0.03
}

}  // namespace

}  // namespace astro::target
