#include <gtest/gtest.h>

#include <cstdio>

#include "common/params/store.hpp"
#include "firmware/app/hosts/flash_layout.hpp"
#include "tests/support/robots/bench_robot.hpp"

// After a restart the log still tells what stopped the robot: which fault, when, and what the robot was
// doing.
namespace astro {
namespace {

using protocol::FaultLogEntry;
using protocol::Mode;

class FaultLogOfARobot : public support::RobotOnBench {
 protected:
  explicit FaultLogOfARobot(const sim::Config& config = quiet()) : RobotOnBench(config) {}

  std::vector<FaultLogEntry> entries() {
    std::vector<FaultLogEntry> all;
    try {
      while (true) all.push_back(ask(protocol::GetFaultLog{static_cast<std::uint16_t>(all.size())}));
    } catch (const robot::RobotRefused& refused) {
      EXPECT_EQ(refused.code(), protocol::ErrorCode::out_of_range);
    }
    return all;
  }
  void drive_line() {
    ask(protocol::Arm{});
    ask(robot::line(5).front());
    run_ms(1500);
    ASSERT_EQ(mode(), Mode::segment);
  }
  void restart() {
    ask(protocol::Reboot{});
    silence_ms(100);
    client_.connect();
  }
  static FaultLogEntry only(const std::vector<FaultLogEntry>& entries) {
    EXPECT_EQ(entries.size(), 1U);
    return entries.empty() ? FaultLogEntry{} : entries.front();
  }
};

TEST_F(FaultLogOfARobot, IsEmptyOnANewRobotAndStartsWriteNothing) {
  EXPECT_TRUE(entries().empty());
  restart();
  restart();
  EXPECT_EQ(board().flash().bytes_worked(), 0U);
}

TEST_F(FaultLogOfARobot, SaysWhatWasGoingOnWhenTheFaultCame) {
  drive_line();
  const auto speeds = drive().wheels().speeds();
  const std::uint64_t now_us = board().clock().now_us();
  board().motors().set_fault(true);
  run_ms(3000);
  const FaultLogEntry entry = only(entries());
  EXPECT_EQ(entry.number, 1U);
  EXPECT_EQ(entry.start, 1U);
  EXPECT_EQ(entry.fault, static_cast<int>(Fault::driver));
  EXPECT_EQ(entry.mode, static_cast<int>(Mode::segment));
  EXPECT_NEAR(static_cast<double>(entry.device_time_us), static_cast<double>(now_us), 2000);
  EXPECT_NEAR(entry.left_umps, speeds.left_umps, 10'000);
  EXPECT_NEAR(entry.right_umps, speeds.right_umps, 10'000);
  EXPECT_NEAR(entry.battery_mv, 12'000, 500);
  EXPECT_EQ(entry.missed, 0);
}

TEST_F(FaultLogOfARobot, IsWrittenOnlyOnceTheRobotStandsWithItsOutputsOff) {
  drive_line();
  ask(protocol::EmergencyStop{});
  int rolled_ms = 0;
  for (; board().flash().bytes_worked() == 0 && rolled_ms < 5000; ++rolled_ms) {
    ASSERT_TRUE(open());
    silence_ms(1);
  }
  const auto wheels = board().drivetrain().speed_radps();
  std::printf("logged %d ms after the emergency stop from 0.5 m/s\n", rolled_ms);
  EXPECT_GT(rolled_ms, 20) << "it still rolled";
  EXPECT_NEAR(wheels[0] * 0.036, 0, 0.003) << "and now it stands";
  EXPECT_NEAR(wheels[1] * 0.036, 0, 0.003);
  EXPECT_EQ(only(entries()).fault, static_cast<int>(Fault::emergency_stop));
}

TEST_F(FaultLogOfARobot, ATimeoutIsLoggedAfterItsRamp) {
  ask(protocol::Arm{});
  ask(protocol::Velocity{300'000, 0});
  silence_ms(250);
  ASSERT_EQ(mode(), Mode::stopping);
  EXPECT_EQ(board().flash().bytes_worked(), 0U) << "the flash may stop the processor: not while it drives";
  silence_ms(2000);
  const FaultLogEntry entry = only(entries());
  EXPECT_EQ(entry.fault, static_cast<int>(Fault::command_timeout));
  EXPECT_EQ(entry.mode, static_cast<int>(Mode::velocity));
  EXPECT_GT(entry.left_umps, 80'000) << "after 200 ms at 0.5 m/s^2";
}

TEST_F(FaultLogOfARobot, SurvivesARestartAndCountsOn) {
  ask(protocol::EmergencyStop{});
  run_ms(20);
  restart();
  EXPECT_EQ(drive().faults().mask(), 0U) << "the latch is RAM";
  EXPECT_EQ(only(entries()).start, 1U);
  run_ms(500);
  ask(protocol::Arm{});
  board().motors().set_fault(true);
  run_ms(100);
  const auto held = entries();
  ASSERT_EQ(held.size(), 2U);
  EXPECT_EQ(held[0].fault, static_cast<int>(Fault::driver));
  EXPECT_EQ(held[0].number, 2U);
  EXPECT_EQ(held[0].start, 2U);
  EXPECT_EQ(held[1].fault, static_cast<int>(Fault::emergency_stop));
  EXPECT_EQ(held[1].start, 1U);
}

TEST_F(FaultLogOfARobot, AStormOfFaultsDoesNotWearTheFlashOut) {
  for (int i = 0; i < 500; ++i) {  // for ten seconds a host clears every fault
    ask(protocol::EmergencyStop{});
    run_ms(10);
    ask(protocol::ClearFaults{});
    run_ms(10);
  }
  const auto held = entries();
  std::printf("500 faults in 10 s: %zu entries\n", held.size());
  EXPECT_LE(held.size(), 16U);
  EXPECT_GT(held.front().missed, 30) << "and says so";
}

TEST_F(FaultLogOfARobot, AFlashThatTakesNothingStopsNobody) {
  for (std::uint32_t sector = 0; sector < sim::Flash::kSectors; ++sector) {
    board().flash().fail(sector, sim::FlashWork::program);
    board().flash().fail(sector, sim::FlashWork::erase);
  }
  ask(protocol::EmergencyStop{});
  run_ms(50);
  const std::uint64_t worked = board().flash().bytes_worked();
  run_ms(500);
  EXPECT_EQ(board().flash().bytes_worked(), worked) << "it is not tried again for ever";
  EXPECT_TRUE(entries().empty());
  ask(protocol::ClearFaults{});
  ask(protocol::Arm{});
  EXPECT_EQ(mode(), Mode::idle);
}

TEST_F(FaultLogOfARobot, ParametersAndFaultsLeaveEachOthersSectorsAlone) {
  ask(protocol::RevertParameters{});
  ask(protocol::StageParameter{static_cast<std::uint16_t>(Param::b), 300'000'000, {}});
  ask(protocol::EmergencyStop{});
  run_ms(50);
  for (int i = 0; i < 100; ++i) ask(protocol::CommitParameters{});
  EXPECT_EQ(entries().size(), 1U);
  restart();
  EXPECT_EQ(ask(protocol::GetParameter{static_cast<std::uint16_t>(Param::b)}).active, 300'000'000);
  EXPECT_EQ(entries().size(), 1U);
}

/// Flash whose newest parameter set was changed by `damage`.
template <class Damage>
sim::Config with_stored_set(const ParameterSet& set, Damage damage) {
  sim::Flash flash;
  FlashLayout<sim::Flash> layout(flash);
  Record record;
  EXPECT_TRUE(record.rewrite(set, 1));
  EXPECT_TRUE(RecordLog(layout.parameters).restart(0, record));
  damage(flash, layout);
  sim::Config config;
  config.slip_m = 0;
  config.flash.assign(flash.content().begin(), flash.content().end());
  return config;
}

sim::Config refused_set() {
  ParameterSet bad;
  bad.set(Param::ki, -1);
  return with_stored_set(bad, [](auto&, auto&) {});
}

struct WithASetThatIsRefused : FaultLogOfARobot {
  WithASetThatIsRefused() : FaultLogOfARobot(refused_set()) {}
};

TEST_F(WithASetThatIsRefused, TheFaultOfTheStartIsLoggedEachTime) {
  EXPECT_EQ(only(entries()).fault, static_cast<int>(Fault::parameters));
  restart();
  ASSERT_EQ(entries().size(), 2U);
  EXPECT_EQ(entries()[0].start, 2U);
}

sim::Config rotten_set() {
  return with_stored_set(ParameterSet(), [](auto& flash, auto& layout) {
    EXPECT_TRUE(Store(layout.parameters).commit(ParameterSet()));
    std::uint32_t last = 0;
    for (std::uint32_t at = 0; at < 4096; ++at)
      if (flash.content()[at] != 0xFF) last = at;
    flash.rot(last, 0x04);
  });
}

struct WithARottenSet : FaultLogOfARobot {
  WithARottenSet() : FaultLogOfARobot(rotten_set()) {}
};

TEST_F(WithARottenSet, TheRobotSaysOnceThatItFellBackToTheOneBefore) {
  EXPECT_EQ(drive().faults().mask(), 0U) << "it is fit to drive";
  run_ms(20);
  EXPECT_EQ(only(entries()).fault, static_cast<int>(Fault::flash));
  restart();
  run_ms(20);
  EXPECT_EQ(entries().size(), 1U) << "not at every start again";
}

}  // namespace
}  // namespace astro
