#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "common/protocol/frame.hpp"
#include "host/robot/client/client.hpp"
#include "host/simulation/robot/virtual_robot.hpp"
#include "tests/support/links/relay_rig.hpp"
#include "tests/support/robots/drive_of.hpp"
#include "tests/support/robots/halt_witness.hpp"
#include "tests/support/robots/random.hpp"

// The relay and the firmware apply one rule, each to its own hosts. Here both are the real ones: three programs share the first
// port through a relay, a fourth has the other port, and all of them ask for motion and halts at random.
namespace astro {
namespace {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages
using simulation::VirtualRobot;
using support::HaltWitness;

constexpr int kShared = 0, kOwn = 1;

/// The firmware behind a relay, with a witness of every millisecond.
class RelayedFirmware : public test::RelayRig {
 public:
  explicit RelayedFirmware(std::uint64_t seed) : robot_(config(seed), {}) {
    receive = [this](const Bytes& bytes) {
      robot_.board().ports().host_write(kShared, bytes);
      return std::vector<Bytes>{};
    };
    tick = [this] {
      robot_.step();
      witness.look(support::drive_of(robot_), robot_.robot().parameters());
      return sent_at_shared_port();
    };
    run(std::chrono::milliseconds(60));  // through boot
  }

  VirtualRobot& firmware() { return robot_; }

  HaltWitness witness;

 private:
  static sim::Config config(std::uint64_t seed) {
    sim::Config config;
    config.seed = seed;
    return config;
  }

  std::vector<Bytes> sent_at_shared_port() {
    std::vector<Bytes> frames;
    std::array<std::uint8_t, 512> bytes{};
    for (std::size_t count = bytes.size(); count == bytes.size();) {
      count = robot_.board().ports().host_read(kShared, bytes);
      for (std::size_t i = 0; i < count; ++i) {
        frame_.push_back(bytes[i]);
        if (bytes[i] != 0) continue;  // the end of a frame
        frames.push_back(std::exchange(frame_, {}));
      }
    }
    return frames;
  }

  VirtualRobot robot_;
  Bytes frame_;
};

/// The way of the program that has the robot's other port for itself.
class OwnPort : public robot::Transport {
 public:
  explicit OwnPort(RelayedFirmware& rig) : rig_(rig) {}

  void write(std::span<const std::uint8_t> bytes) override {
    rig_.firmware().board().ports().host_write(kOwn, bytes);
  }
  std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override {
    const microseconds deadline = rig_.now + timeout;
    while (true) {
      if (const std::size_t count = rig_.firmware().board().ports().host_read(kOwn, into)) return count;
      if (rig_.now >= deadline) return 0;
      rig_.step();
    }
  }
  microseconds now() const override { return rig_.now; }
  void reopen(microseconds) override { throw Error("this port is not opened again"); }
  const std::string& name() const override { return name_; }

 private:
  RelayedFirmware& rig_;
  std::string name_ = "port1";
};

class Programs {
 public:
  explicit Programs(std::uint64_t seed) : random_(seed), rig_(seed) {
    for (int who = 0; who < kOwnProgram; ++who) start(who);
    own_.connect();
  }

  /// Until something is violated.
  void live(int acts) {
    for (int i = 0; i < acts && violation().empty(); ++i) act();
  }

  const std::string& violation() const {
    return left_driving_.empty() ? rig_.witness.violation() : left_driving_;
  }
  int killed_while_driving() const { return killed_while_driving_; }
  int taken() const { return taken_; }
  int refused_after_halt() const { return refused_after_halt_; }

 private:
  static constexpr int kOwnProgram = 3;  // after those that share the other port

  void act() {
    const int who = static_cast<int>(random_.between(0, kOwnProgram));
    const double what = random_.uniform(0, 1);
    if (what < 0.10) return ask(who, Arm{});
    if (what < 0.13) return ask(who, Stop{});
    if (what < 0.17) return ask(who, Pause{});
    if (what < 0.22) return ask(who, Resume{});
    if (what < 0.24) return ask(who, Disarm{});
    if (what < 0.25) return ask(who, EmergencyStop{});
    if (what < 0.27) return ask(who, ClearFaults{});
    if (what < 0.31 && who != kOwnProgram) return kill(who);
    if (what < 0.34) return ask(who, Rest{});
    if (what < 0.37) return ask(who, WheelVoltage{3000, 3000});
    if (what < 0.55)
      return ask(who, AddSegment{.kind = SegmentKind::line,
                                 .tag = 1,
                                 .length_nm = random_.between(-500'000'000, 500'000'000)});
    if (what < 0.62) return rig_.run(std::chrono::milliseconds(random_.between(1, 2500)));
    ask(who, Velocity{static_cast<std::int32_t>(random_.between(-700'000, 700'000)), 0});
  }

  void start(int who) {
    shared_[static_cast<std::size_t>(who)] =
        std::make_unique<test::RelayedProgram>(rig_, who + 1, "astrolabe");
  }

  /// Its connection ends, and another program takes its place. The robot stops for one that drives.
  void kill(int who) {
    // One that was stopped, and whose robot drives for the other port since, is none.
    const bool drives = rig_.relay.driver() == shared_[static_cast<std::size_t>(who)]->id() &&
                        rig_.witness.driver().port == who;
    const bool halted = rig_.witness.halted();
    const long stops = rig_.count(Stop::kId);
    shared_[static_cast<std::size_t>(who)]->leave();
    rig_.run(std::chrono::milliseconds(2));
    const bool stopped = rig_.count(Stop::kId) > stops;
    killed_while_driving_ += drives && !halted ? 1 : 0;
    if (stopped) rig_.witness.answered({who, false}, Stop::kId, true);
    if (drives && !halted && !stopped)
      left_driving_ = "nobody stopped the robot for a driver that was killed";
    start(who);
  }

  template <Request M>
  void ask(int who, const M& message) {
    bool taken = true;
    const bool onlooker = M::kId != Arm::kId && looks_on(who);
    const bool halted = rig_.witness.halted();
    try {
      client(who).request(message);
    } catch (const robot::RobotRefused&) {
      taken = false;
    }
    const bool motion = HaltWitness::is_motion(M::kId);
    taken_ += taken && motion ? 1 : 0;
    refused_after_halt_ += halted && !taken && motion ? 1 : 0;
    rig_.witness.answered({who, onlooker}, M::kId, taken);
  }

  /// The relay lets a driver go at a fault, and from then on marks its requests as those of one who looks on.
  bool looks_on(int who) {
    return who != kOwnProgram && rig_.relay.driver() != shared_[static_cast<std::size_t>(who)]->id();
  }

  robot::Client& client(int who) {
    return who == kOwnProgram ? own_ : shared_[static_cast<std::size_t>(who)]->client;
  }

  support::Random random_;
  RelayedFirmware rig_;
  std::array<std::unique_ptr<test::RelayedProgram>, kOwnProgram> shared_;
  OwnPort own_port_{rig_};
  robot::Client own_{own_port_};
  int taken_ = 0, refused_after_halt_ = 0, killed_while_driving_ = 0;
  std::string left_driving_;
};

TEST(RelayedStop, HoldsForProgramsOfOnePortAndOfTheOther) {
  const std::uint64_t count = support::number_from("ASTROLABE_STOPS", 50);
  const std::uint64_t first = support::number_from("ASTROLABE_STOPS_SEED", 20'261'125);
  int taken = 0, refused = 0, killed = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    Programs programs(seed);
    programs.live(200);
    ASSERT_EQ(programs.violation(), "") << "ASTROLABE_STOPS=1 ASTROLABE_STOPS_SEED=" << seed << " repeats it";
    taken += programs.taken();
    refused += programs.refused_after_halt();
    killed += programs.killed_while_driving();
  }
  fmt::print(
      "{} lives from seed {}: {} motion requests were taken, {} refused after a halt; {} drivers were "
      "killed\n",
      count, first, taken, refused, killed);
  EXPECT_GT(taken, 2 * static_cast<int>(count)) << "the robot drove";
  EXPECT_GT(refused, 2 * static_cast<int>(count)) << "the halts mattered";
  EXPECT_GT(killed, static_cast<int>(count) / 50) << "drivers were killed while they drove";
}

}  // namespace
}  // namespace astro
