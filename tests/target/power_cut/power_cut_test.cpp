#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/params/table.hpp"
#include "host/emulator/emulated_robot.hpp"
#include "host/link/client.hpp"

namespace astro::emulator {
namespace {

using namespace std::chrono_literals;

constexpr const char* kImage = ASTRO_IMAGE_DIR "/astrolabe-teensy40.hex";
constexpr std::uint16_t kParameter = static_cast<std::uint16_t>(Param::c_R);
constexpr std::int32_t kOne = 1 << 30, kOld = kOne + 1111, kNew = kOne + 2222;

using Content = std::vector<std::uint8_t>;

/// One emulated robot whose flash is put back before each cut.
class CutRobot {
 public:
  CutRobot() {
    // What is proved is the order of work, not how long it takes.
    robot_->teensy().flash().times = {50 * kCyclesPerMicrosecond, 500 * kCyclesPerMicrosecond};
  }

  Content content() {
    const auto bytes = flash().parameters();
    return {bytes.begin(), bytes.end()};
  }
  void start_with(const Content& content) {
    std::copy(content.begin(), content.end(), flash().parameters().begin());
    robot_->teensy().power_cycle();
    client_.connect();
  }
  /// True if the robot says that the set is in force.
  bool commit(std::int32_t value) {
    try {
      client_.request(protocol::StageParameter{kParameter, value, {}});
      client_.request(protocol::CommitParameters{});
      return true;
    } catch (const link::RobotRefused&) {
      return false;
    }
  }
  std::int32_t after_power_cycle() {
    robot_->teensy().power_cycle();
    client_.connect();
    EXPECT_EQ(client_.request(protocol::GetStatus{}).latched_faults, 0U) << "the robot found no valid set";
    return client_.request(protocol::GetParameter{kParameter}).active;
  }
  NorFlash& flash() { return robot_->teensy().flash(); }

 private:
  std::shared_ptr<EmulatedRobot> robot_ =
      std::make_shared<EmulatedRobot>(kImage, sim::Config{}, simulator::MocapConfig{});
  link::Client client_{std::make_unique<PortTransport>(robot_, Port::serial)};
};

/// A flash that holds the old set, such that the next commit begins with (or does without) erasing a sector.
Content before_a_commit(CutRobot& robot, bool erases) {
  robot.start_with(Content(NorFlash::kParametersEnd - NorFlash::kParameters, 0xFF));
  // A sector takes an even number of records: with this one the new set is the one that erases.
  EXPECT_TRUE(!erases || robot.commit(kOne));
  EXPECT_TRUE(robot.commit(kOld));
  for (int commits = 0; commits < 100; ++commits) {
    const Content before = robot.content();
    const std::uint64_t worked = robot.flash().bytes_worked();
    EXPECT_TRUE(robot.commit(kNew));
    if ((robot.flash().bytes_worked() - worked >= 4096) == erases) return before;
    EXPECT_TRUE(robot.commit(kOld));
  }
  ADD_FAILURE() << "no commit of this kind";
  return {};
}

struct Share {
  bool erases;
  unsigned part, parts;
};

class PowerCut : public testing::TestWithParam<Share> {};

TEST_P(PowerCut, AtAnyWordLeavesTheOldSetOrTheNewOne) {
  const auto [erases, part, parts] = GetParam();
  CutRobot robot;
  const Content before = before_a_commit(robot, erases);
  robot.start_with(before);
  const std::uint64_t begun = robot.flash().bytes_worked();
  ASSERT_TRUE(robot.commit(kNew));
  const std::uint64_t whole = robot.flash().bytes_worked() - begun;
  int old_sets = 0, new_sets = 0;
  for (std::uint64_t cut = 4 * part; cut <= whole; cut += 4 * parts) {
    robot.start_with(before);
    robot.flash().cut_power_after(cut, cut % 8 == 0 ? sim::Tear::sharp : sim::Tear::torn);
    const bool said_done = robot.commit(kNew);
    const std::int32_t found = robot.after_power_cycle();
    ASSERT_TRUE(found == kOld || found == kNew) << "cut after " << cut << " bytes: " << found;
    ASSERT_TRUE(!said_done || found == kNew)
        << "cut after " << cut << " bytes: said to be in force, and lost";
    (found == kOld ? old_sets : new_sets) += 1;
  }
  fmt::print("{} bytes of work, cut at {} places: {} times the old set, {} times the new one\n", whole,
             old_sets + new_sets, old_sets, new_sets);
  EXPECT_GT(old_sets, 0);
}

INSTANTIATE_TEST_SUITE_P(Append, PowerCut, testing::Values(Share{false, 0, 1}));
INSTANTIATE_TEST_SUITE_P(Erase, PowerCut,
                         testing::Values(Share{true, 0, 8}, Share{true, 1, 8}, Share{true, 2, 8},
                                         Share{true, 3, 8}, Share{true, 4, 8}, Share{true, 5, 8},
                                         Share{true, 6, 8}, Share{true, 7, 8}));

}  // namespace
}  // namespace astro::emulator
