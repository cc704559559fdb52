#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "common/params/table.hpp"
#include "host/emulator/robot/emulated_robot.hpp"
#include "host/robot/client/client.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/target/firmware_file.hpp"

namespace astro::emulator {
namespace {

using namespace std::chrono_literals;
using target::kImage;

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
    put_back(content);
    robot_->teensy().power_cycle();
    client_.connect();
  }
  /// The commit reads the flash anew, so the robot need not start again to find what now lies there.
  void put_back(const Content& content) {
    std::copy(content.begin(), content.end(), flash().parameters().begin());
  }
  /// True if the robot says that the set is in force.
  bool commit(std::int32_t value) {
    try {
      client_.request(protocol::RevertParameters{});
      client_.request(protocol::StageParameter{kParameter, value, {}});
      client_.request(protocol::CommitParameters{});
      return true;
    } catch (const robot::RobotRefused&) {
      return false;
    }
  }
  std::int32_t after_power_cycle() {
    robot_->teensy().power_cycle();
    client_.connect();
    EXPECT_EQ(client_.request(protocol::GetStatus{}).latched_faults, 0U) << "the robot found no valid set";
    return client_.request(protocol::GetParameter{kParameter}).active;
  }
  FlashChip& flash() { return robot_->teensy().flash(); }

 private:
  std::shared_ptr<EmulatedRobot> robot_ =
      std::make_shared<EmulatedRobot>(kImage, sim::Config{}, simulation::MocapConfig{});
  robot::Client client_{std::make_unique<PortTransport>(robot_, Port::serial)};
};

/// Bytes that held something are blank now: a sector of old records was erased, not one that was blank
/// before, in which each place of a cut would leave the same.
bool wiped(const Content& before, const Content& after) {
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i] != 0xFF && after[i] == 0xFF) return true;
  return false;
}

/// A flash that holds the old set, such that the next commit begins with (or does without) erasing a sector
/// that is full of older records.
Content before_a_commit(CutRobot& robot, bool erases) {
  robot.start_with(Content(FlashChip::kParametersEnd - FlashChip::kParameters, 0xFF));
  EXPECT_TRUE(robot.commit(kOld));
  bool shifted = false;
  for (int commits = 0; commits < 200; ++commits) {
    const Content before = robot.content();
    const std::uint64_t worked = robot.flash().bytes_worked();
    EXPECT_TRUE(robot.commit(kNew));
    const bool erased = robot.flash().bytes_worked() - worked >= 4096;
    if (erases ? wiped(before, robot.content()) : !erased) return before;
    const Content between = robot.content();
    EXPECT_TRUE(robot.commit(kOld));
    // If a sector takes an even number of records the old set would begin each one. With an odd number they take turns.
    if (!shifted && wiped(between, robot.content())) {
      EXPECT_TRUE(robot.commit(kOld));
      shifted = true;
    }
  }
  ADD_FAILURE() << "no commit of this kind";
  return {};
}

/// Where within the work the kind of damage changes: begin and end of each record in the sector that is
/// erased and of the one that is written after it, so every word of every header and of every CRC; the ends
/// of the sector and of the pages that are written. Elsewhere one word is like its neighbour: one in fifteen
/// is cut.
class Places {
 public:
  Places(const Content& before, const Content& after, bool erases) : erases_(erases) {
    if (!erases) return;
    std::size_t at = 0;
    while (before[at] == after[at]) ++at;
    const std::size_t sector = at / kSector * kSector;
    for (std::size_t byte = 0; byte < kSector; byte += 4) {
      if (begins(before, sector + byte))
        record(byte, before[sector + byte + 6] + 256 * before[sector + byte + 7]);
    }
    const int written = after[sector + 6] + 256 * after[sector + 7];
    record(kSector, written);
    for (int page = kPage; page < written; page += kPage)
      edges_.push_back(kSector + static_cast<std::size_t>(page));
  }
  bool worth_a_cut(std::uint64_t at) const {
    const auto near = [at](std::uint64_t edge) { return at + kNear >= edge && at <= edge + kNear; };
    // 15 words: sharp and torn cuts take turns.
    return !erases_ || support::thorough() || at % 60 == 0 || std::any_of(edges_.begin(), edges_.end(), near);
  }

 private:
  static constexpr std::size_t kSector = 4096, kNear = 16, kAroundPayload = 16;
  static constexpr int kPage = 256;
  static bool begins(const Content& content, std::size_t at) {
    return std::equal(kMagic.begin(), kMagic.end(), content.begin() + static_cast<std::ptrdiff_t>(at));
  }
  void record(std::size_t begin, int payload) {
    edges_.push_back(begin);
    edges_.push_back(begin + kAroundPayload + static_cast<std::size_t>(payload));
  }

  static constexpr std::string_view kMagic = "ASTP";
  bool erases_;
  std::vector<std::uint64_t> edges_;
};

struct Share {
  bool erases;
  unsigned part, parts;
};

class PowerCut : public testing::TestWithParam<Share> {};

TEST_P(PowerCut, LeavesTheOldSetOrTheNewOne) {
  const auto [erases, part, parts] = GetParam();
  CutRobot robot;
  const Content before = before_a_commit(robot, erases);
  ASSERT_FALSE(before.empty());
  robot.start_with(before);
  const std::uint64_t begun = robot.flash().bytes_worked();
  ASSERT_TRUE(robot.commit(kNew));
  const std::uint64_t whole = robot.flash().bytes_worked() - begun;
  const Places places(before, robot.content(), erases);
  int old_sets = 0, new_sets = 0;
  // Each time at every seventh place: an odd number, so that sharp and torn cuts take turns, and smaller than what is cut round an edge.
  const auto step = static_cast<unsigned>(support::how_often(7, 1));
  unsigned place = 0;
  for (std::uint64_t cut = 0; cut <= whole; cut += 4) {
    if (!places.worth_a_cut(cut)) continue;
    const unsigned now = place++;
    if (now % step != 0 || now / step % parts != part) continue;
    robot.put_back(before);
    robot.flash().cut_power_after(cut, cut % 8 == 0 ? sim::Tear::sharp : sim::Tear::torn);
    const bool said_done = robot.commit(kNew);
    ASSERT_FALSE(robot.flash().powered()) << "cut after " << cut << " bytes";
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

// If nothing is erased, the power is cut at every word.
INSTANTIATE_TEST_SUITE_P(Append, PowerCut, testing::Values(Share{false, 0, 2}, Share{false, 1, 2}));
INSTANTIATE_TEST_SUITE_P(Erase, PowerCut,
                         testing::Values(Share{true, 0, 3}, Share{true, 1, 3}, Share{true, 2, 3}));

}  // namespace
}  // namespace astro::emulator
