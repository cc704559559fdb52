#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "host/robot/client/client.hpp"
#include "host/simulation/robot/virtual_robot.hpp"
#include "tests/common/fixed/seeded.hpp"
#include "tests/support/robots/drive_of.hpp"

// Long random lives of a robot: commands, faults, silence, noise on the line, power cuts and restarts in any
// order. After every millisecond the invariants are checked.
namespace astro {
namespace {

using protocol::Mode;
using simulation::VirtualRobot;

constexpr int kSteps = 50'000;

/// Checks the robot after every tick.
class Witness {
 public:
  explicit Witness(VirtualRobot& robot) : robot_(robot) {}

  bool arm_asked = false;
  bool pose_may_jump = false;

  void look() {
    const Drive& drive = support::drive_of(robot_);
    const bool powered = robot_.board().motors().state() == sim::Bridge::drive;
    ASSERT_TRUE(!powered || drive.armed()) << "output while " << protocol::name(drive.mode());
    ASSERT_TRUE(was_armed_ || !drive.armed() || arm_asked) << "armed by itself";
    was_armed_ = drive.armed();
    look_at_pose(drive);
    look_at_queue(drive);
    ++ticks_;
  }
  std::uint64_t ticks() const { return ticks_; }

 private:
  void look_at_pose(const Drive& drive) {
    const double x_m = std::ldexp(static_cast<double>(drive.pose().x), -40);
    const double y_m = std::ldexp(static_cast<double>(drive.pose().y), -40);
    ASSERT_TRUE(std::isfinite(x_m) && std::isfinite(y_m));
    // More than four times over_speed at one wheel is refused: 4.8 mm in a tick, half of it at the centre.
    ASSERT_TRUE(pose_may_jump || std::hypot(x_m - x_m_, y_m - y_m_) < 0.0026) << "the pose jumped";
    pose_may_jump = false;
    x_m_ = x_m;
    y_m_ = y_m;
  }

  /// A path continues or ends, and a queue that can start starts.
  void look_at_queue(const Drive& drive) {
    const bool waits = drive.mode() == Mode::idle && drive.queued() != 0;
    const std::uint32_t progress = drive.follower().profile().progress_16();
    const bool same = drive.mode() == Mode::segment && drive.running_tag() == tag_ && progress == progress_;
    still_ms_ = waits || same ? still_ms_ + 1 : 0;
    tag_ = drive.running_tag();
    progress_ = progress;
    // The longest that a segment settles is 700 ms; the slowest here moves 2^-16 of itself in less.
    ASSERT_LT(still_ms_, 1000) << "the queue is stuck in " << protocol::name(drive.mode());
  }

  VirtualRobot& robot_;
  bool was_armed_ = false;
  double x_m_ = 0, y_m_ = 0;
  std::uint16_t tag_ = 0;
  std::uint32_t progress_ = 0;
  int still_ms_ = 0;
  std::uint64_t ticks_ = 0;
};

/// The link in process, with the witness at every tick.
class WitnessedTransport : public robot::Transport {
 public:
  WitnessedTransport(VirtualRobot& robot, Witness& witness) : robot_(robot), witness_(witness) {}

  void write(std::span<const std::uint8_t> bytes) override {
    while (!bytes.empty()) {
      bytes = bytes.subspan(robot_.board().ports().host_write(0, bytes));
      if (!bytes.empty()) step();
    }
  }
  std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override {
    const microseconds deadline = now() + timeout;
    while (true) {
      const std::size_t count = robot_.board().ports().host_read(0, into);
      if (count != 0 || now() >= deadline) return count;
      step();
    }
  }
  microseconds now() const override {
    return microseconds(static_cast<std::int64_t>(robot_.board().world_us()));
  }
  void reopen(microseconds) override {}
  const std::string& name() const override { return name_; }

  void step() {
    robot_.step();
    witness_.look();
  }

 private:
  VirtualRobot& robot_;
  Witness& witness_;
  std::string name_ = "the campaign's robot";
};

class Campaign {
 public:
  explicit Campaign(std::uint64_t seed) : random_(seed), robot_(config(seed), simulation::MocapConfig{}) {
    client_.connect();
  }

  void run() {
    for (int step = 0; step < kSteps && !testing::Test::HasFatalFailure(); ++step) {
      const auto& [name, act] = kActs[static_cast<std::size_t>(random_.between(0, std::ssize(kActs) - 1))];
      SCOPED_TRACE(fmt::format("step {}: {}", step, name));
      try {
        (this->*act)();
        ++done_[name];
      } catch (const robot::RobotRefused&) {
        ++refused_;
      } catch (const robot::LinkLost&) {
        ++lost_;  // it restarted while a request was under way
      }
      witness_.arm_asked = false;
    }
    fmt::print(
        "{} steps, {} ticks, {} requests refused, {} cut by a restart, {} restarts, {} cut commits, {} paths "
        "begun\n",
        kSteps, witness_.ticks(), refused_, lost_, restarts_, cut_commits_, done_["add_segment"]);
  }

  void expect_variety() {
    EXPECT_GT(restarts_, 1000);
    EXPECT_GT(cut_commits_, 500);
    EXPECT_GT(done_["add_segment"], 1000);
    EXPECT_GT(done_["velocity"], 400);
    EXPECT_GT(refused_, 5000);
  }

 private:
  using Act = void (Campaign::*)();

  static sim::Config config(std::uint64_t seed) {
    sim::Config config;
    config.seed = seed;
    config.motor_mismatch = 0.1;
    return config;
  }

  void silence(int ms) {
    for (int i = 0; i < ms; ++i) transport_.step();
  }

  void arm() {
    witness_.arm_asked = true;
    client_.request(protocol::Arm{});
  }
  void disarm() { client_.request(protocol::Disarm{}); }
  void stop() { client_.request(protocol::Stop{}); }
  void pause() { client_.request(protocol::Pause{}); }
  void resume() { client_.request(protocol::Resume{}); }
  void emergency_stop() { client_.request(protocol::EmergencyStop{}); }
  void clear() { client_.request(protocol::ClearFaults{}); }
  void clear_and_arm() {
    clear();
    arm();
  }
  void velocity() {
    client_.request(
        protocol::Velocity{random_.between32(-900'000, 900'000), random_.between32(-3'000'000, 3'000'000)});
    client_.pump(std::chrono::milliseconds(random_.between(1, 180)));
  }
  void voltages() {
    client_.request(
        protocol::WheelVoltage{random_.between32(-5'000, 5'000), random_.between32(-5'000, 5'000)});
    client_.pump(std::chrono::milliseconds(random_.between(1, 100)));
  }
  void add_segment() {
    protocol::AddSegment segment;
    segment.kind = static_cast<protocol::SegmentKind>(random_.between(0, 3));
    segment.tag = static_cast<std::uint16_t>(random_.between(1, 60'000));
    using enum protocol::SegmentKind;
    if (segment.kind == line || segment.kind == arc)
      segment.length_nm = random_.between(-400'000'000, 400'000'000);
    if (segment.kind == spin || segment.kind == arc) segment.angle = random_.any_size(31);
    if (segment.kind == protocol::SegmentKind::stop)
      segment.dwell_ms = static_cast<std::uint32_t>(random_.between(1, 300));
    client_.request(segment);
  }
  void wait() { client_.pump(std::chrono::milliseconds(random_.between(1, 400))); }
  void cut_the_link() { silence(static_cast<int>(random_.between(1, 700))); }
  void noise() {
    std::array<std::uint8_t, 40> bytes{};
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_.bits());
    transport_.write(bytes);
    silence(5);
  }

  void commit() {
    client_.request(protocol::RevertParameters{});
    const std::int32_t b_nm = random_.between32(280'000'000, 300'000'000);
    under_way_ = committed_;
    under_way_.set(Param::b, b_nm);
    client_.request(protocol::StageParameter{static_cast<std::uint16_t>(Param::b), b_nm, {}});
    client_.request(protocol::CommitParameters{});
    committed_ = under_way_;
  }
  void cut_power_in_a_commit() {
    if (support::drive_of(robot_).gives_power()) return;
    robot_.board().flash().cut_power_after(static_cast<std::uint64_t>(random_.between(0, 1500)),
                                           sim::Tear::torn);
    try {
      commit();
    } catch (const robot::RobotRefused&) {
    }
    start_again(hal::ResetCause::power_on);
    ++cut_commits_;
  }
  void reboot() {
    client_.request(protocol::Reboot{});
    for (int ms = 0; ms < 60; ++ms) {
      witness_.pose_may_jump = true;  // the odometry starts again
      transport_.step();
    }
    come_back();
  }
  void power_cut() { start_again(hal::ResetCause::power_on); }
  void hang() { start_again(hal::ResetCause::watchdog); }

  void start_again(hal::ResetCause cause) {
    robot_.board().flash().restore_power();
    robot_.restart(cause);
    witness_.pose_may_jump = true;
    transport_.step();
    come_back();
    EXPECT_EQ(support::drive_of(robot_).faults().first() == Fault::watchdog,
              cause == hal::ResetCause::watchdog);
  }
  void come_back() {
    ++restarts_;
    client_.connect();
    ASSERT_FALSE(support::drive_of(robot_).armed());
    const ParameterSet& now = robot_.robot().parameters();
    ASSERT_TRUE(now == committed_ || now == under_way_) << "neither the old set nor the new";
    committed_ = under_way_ = now;
  }

  void driver_fault() {
    robot_.board().motors().set_fault(true);
    silence(static_cast<int>(random_.between(1, 30)));
    robot_.board().motors().set_fault(false);
  }
  void supply_dip() {
    robot_.board().battery().set_open_circuit_V(static_cast<double>(random_.between(80, 160)) / 10);
    client_.pump(std::chrono::milliseconds(random_.between(1, 250)));
    robot_.board().battery().set_open_circuit_V(12);
  }
  void encoder_jump() {
    const hal::EncoderCounts now = robot_.board().encoders().read();
    robot_.board().encoders().preset({now.left + random_.between32(-100'000, 100'000), now.right});
    silence(2);
  }
  void blocked_wheel() {
    robot_.board().set_load(Side::right, {.drag_Nm = 100});
    client_.pump(std::chrono::milliseconds(random_.between(1, 600)));
    robot_.board().set_load(Side::right, {});
  }

  static constexpr std::array<std::pair<const char*, Act>, 33> kActs{{
      {"arm", &Campaign::arm},
      {"arm", &Campaign::arm},
      {"clear", &Campaign::clear},
      {"clear and arm", &Campaign::clear_and_arm},
      {"clear and arm", &Campaign::clear_and_arm},
      {"clear and arm", &Campaign::clear_and_arm},
      {"disarm", &Campaign::disarm},
      {"stop", &Campaign::stop},
      {"pause", &Campaign::pause},
      {"resume", &Campaign::resume},
      {"resume", &Campaign::resume},
      {"emergency stop", &Campaign::emergency_stop},
      {"velocity", &Campaign::velocity},
      {"velocity", &Campaign::velocity},
      {"voltages", &Campaign::voltages},
      {"add_segment", &Campaign::add_segment},
      {"add_segment", &Campaign::add_segment},
      {"add_segment", &Campaign::add_segment},
      {"add_segment", &Campaign::add_segment},
      {"wait", &Campaign::wait},
      {"wait", &Campaign::wait},
      {"wait", &Campaign::wait},
      {"cut the link", &Campaign::cut_the_link},
      {"noise", &Campaign::noise},
      {"commit", &Campaign::commit},
      {"cut power in a commit", &Campaign::cut_power_in_a_commit},
      {"reboot", &Campaign::reboot},
      {"power cut", &Campaign::power_cut},
      {"driver fault", &Campaign::driver_fault},
      {"supply dip", &Campaign::supply_dip},
      {"encoder jump", &Campaign::encoder_jump},
      {"blocked wheel", &Campaign::blocked_wheel},
      {"hang", &Campaign::hang},
  }};

  tests::Seeded random_;
  VirtualRobot robot_;
  Witness witness_{robot_};
  WitnessedTransport transport_{robot_, witness_};
  robot::Client client_{transport_};
  ParameterSet committed_, under_way_;  // under way: of a commit whose answer did not come
  std::map<std::string, int> done_;
  int refused_ = 0, lost_ = 0, restarts_ = 0, cut_commits_ = 0;
};

TEST(Campaign, WhateverHappensNothingMovesUnaskedAndNothingIsLost) {
  Campaign campaign(20'261'121);
  campaign.run();
  campaign.expect_variety();
}

}  // namespace
}  // namespace astro
