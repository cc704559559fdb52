#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "firmware/app/hosts/flash_layout.hpp"
#include "tests/support/robots/bench_robot.hpp"

// If committed parameters are lost the robot reports it before anybody drives with older ones. Otherwise it
// raises no alarm, whenever the power fails.
namespace astro {
namespace {

using protocol::ErrorCode;
using Flash = sim::Flash;
constexpr std::uint32_t kParameterSectors = FlashLayout<Flash>::kParameterSectors;

class LostParameters : public support::RobotOnBench {
 protected:
  static constexpr std::uint16_t kId = static_cast<std::uint16_t>(Param::b);
  static constexpr std::int32_t kFirst = 280'000'000;

  /// Commits wheelbases that count up by a nanometre. `number` commits later the value is kFirst + number
  /// - 1.
  void commit(int number = 1) {
    for (int i = 0; i < number; ++i) {
      ask(protocol::RevertParameters{});
      ask(protocol::StageParameter{kId, kFirst + committed_, {}});
      ask(protocol::CommitParameters{});
      ++committed_;
    }
  }
  std::int32_t in_force() { return ask(protocol::GetParameter{kId}).active; }
  std::uint32_t faults() { return ask(protocol::GetStatus{}).latched_faults; }
  void power_cycle() {
    board().flash().restore_power();
    robot_->restart(hal::ResetCause::power_on);
    client_.connect();
    run_ms(60);
  }
  void lose(std::uint32_t sector) { board().flash().erase(sector); }
  std::uint32_t newest_sector() {
    FlashLayout<Flash> layout(board().flash());
    Record record;
    return RecordLog(layout.parameters).newest(record).sector();
  }
  std::vector<std::uint8_t> content() {
    const auto cells = board().flash().content();
    return {cells.begin(), cells.end()};
  }

  int committed_ = 0;
};

TEST_F(LostParameters, ANewRobotRaisesNoAlarmNorOneThatKeepsWhatItHas) {
  power_cycle();
  EXPECT_EQ(faults(), 0U);
  for (int i = 0; i < 60; ++i) {
    commit();
    power_cycle();
    ASSERT_EQ(faults(), 0U) << i;
    ASSERT_EQ(in_force(), kFirst + i);
  }
}

TEST_F(LostParameters, AllSectorsGoneIsAFaultThatSaysSoUntilSomebodyCommitsAgain) {
  commit(3);
  for (std::uint32_t sector = 0; sector < kParameterSectors; ++sector) lose(sector);
  for (int start = 0; start < 3; ++start) {
    power_cycle();
    EXPECT_EQ(faults(), bit(Fault::parameters));
    EXPECT_EQ(in_force(), 290'000'000) << "the default";
    const robot::RobotRefused refused = refusal(protocol::Arm{});
    EXPECT_EQ(refused.code(), ErrorCode::faulted);
    EXPECT_EQ(refused.detail(), static_cast<int>(Fault::parameters));
  }
  ask(protocol::ClearFaults{});
  ask(protocol::Arm{});  // allowed once the fault is cleared
  ask(protocol::Disarm{});
  commit();
  power_cycle();
  EXPECT_EQ(faults(), 0U);
  EXPECT_EQ(in_force(), kFirst + 3);
  for (std::uint32_t sector = 0; sector < kParameterSectors; ++sector) lose(sector);
  power_cycle();
  EXPECT_EQ(faults(), bit(Fault::parameters)) << "and the next loss is noticed, too";
}

TEST_F(LostParameters, AnOlderSetInForceForWantOfTheNewestSectorIsAFault) {
  for (int turn = 0; turn < 6; ++turn) {
    const std::uint32_t sector = newest_sector();
    do commit();
    while (newest_sector() == sector);
    commit(turn);
    const std::int32_t newest = in_force();
    const auto before = content();
    lose(newest_sector());
    power_cycle();
    EXPECT_EQ(faults(), bit(Fault::parameters)) << turn;
    EXPECT_LT(in_force(), newest);
    board().flash().put_back(0, before);
    power_cycle();
    EXPECT_EQ(faults(), 0U);
    EXPECT_EQ(in_force(), newest);
  }
}

TEST_F(LostParameters, TheLossIsNoticedHoweverOftenTheFaultLogHasTurnedRound) {
  commit(2);
  for (int i = 0; i < 150; ++i) {
    if (i % 15 == 0) power_cycle();  // more than 16 at once are not logged
    ask(protocol::EmergencyStop{});
    run_ms(1100);
    ask(protocol::ClearFaults{});
  }
  EXPECT_GE(board().flash().erases(kParameterSectors) + board().flash().erases(kParameterSectors + 1), 3U)
      << "the log has erased its sectors";
  for (std::uint32_t sector = 0; sector < kParameterSectors; ++sector) lose(sector);
  power_cycle();
  EXPECT_EQ(faults(), bit(Fault::parameters));
}

TEST_F(LostParameters, APowerCutAnywhereInACommitRaisesNoAlarmAndHidesNoLoss) {
  commit(2);
  int cuts = 0, old_sets = 0;
  // Commits that stay in a sector, and those that begin one and set the mark.
  for (int commits = 0; commits < 30; ++commits) {
    const auto before = content();
    const std::uint64_t begun = board().flash().bytes_worked();
    commit();
    const std::uint64_t whole = board().flash().bytes_worked() - begun;
    const auto after = content();
    const std::int32_t newest = kFirst + committed_ - 1;
    const bool marks =
        !std::equal(after.begin() + std::ptrdiff_t{kParameterSectors} * Flash::kSectorBytes, after.end(),
                    before.begin() + std::ptrdiff_t{kParameterSectors} * Flash::kSectorBytes);
    if (!marks && commits != 3) continue;
    // Every cut within the last bytes, which are the end of the record and the marks; some cuts before them.
    constexpr std::uint64_t kLast = 60;
    const auto step = [whole](std::uint64_t cut) {
      return cut + kLast < whole ? std::min<std::uint64_t>(97, whole - kLast - cut) : 1;
    };
    for (std::uint64_t cut = 0; cut <= whole; cut += step(cut)) {
      board().flash().put_back(0, before);
      power_cycle();
      board().flash().cut_power_after(cut, cut % 2 == 0 ? sim::Tear::torn : sim::Tear::byte, cut);
      --committed_;
      try {
        commit();
      } catch (const robot::RobotRefused&) {
        ++committed_;
      }
      power_cycle();
      ASSERT_EQ(faults() & bit(Fault::parameters), 0U) << "cut after " << cut << " of " << whole;
      const std::int32_t found = in_force();
      ASSERT_TRUE(found == newest || found == newest - 1) << "cut after " << cut;
      old_sets += found == newest ? 0 : 1;
      ++cuts;
      lose(newest_sector());
      power_cycle();
      ASSERT_NE(faults() & bit(Fault::parameters), 0U) << "cut after " << cut << ": the loss was hidden";
    }
    board().flash().put_back(0, after);
    power_cycle();
  }
  std::printf("%d cuts, %d times the old set: no false alarm, no loss hidden\n", cuts, old_sets);
  EXPECT_GT(cuts, 200);
  EXPECT_GT(old_sets, 10);
}

TEST_F(LostParameters, APoseAtTheEdgeOfItsRangeIsRefused) {
  constexpr std::int64_t kHalf = std::int64_t{1} << 62;
  for (const std::int64_t x : {kHalf + 1, -kHalf - 1, INT64_MAX, INT64_MIN}) {
    EXPECT_EQ(refusal(protocol::SetPose{x, 0, 0}).code(), ErrorCode::out_of_range);
    EXPECT_EQ(refusal(protocol::SetPose{0, x, 0}).code(), ErrorCode::out_of_range);
  }
  EXPECT_EQ(drive().pose().x, 0);
  ask(protocol::SetPose{kHalf, -kHalf, 1});
  EXPECT_EQ(drive().pose().x, kHalf);
}

}  // namespace
}  // namespace astro
