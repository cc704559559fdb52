#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "tests/contract/rig.hpp"

/// The words of hal/interface/board.hpp as claims, run on every port:
/// `INSTANTIATE_TYPED_TEST_SUITE_P(Sim, BoardContract, SimRig)`. Serial ports and flash are in
/// io_contract.hpp.
namespace astro::contract {

template <Rig R>
class BoardContract : public testing::Test {
 protected:
  auto& board() { return rig.board(); }
  R rig;
};
TYPED_TEST_SUITE_P(BoardContract);

TYPED_TEST_P(BoardContract, ClockIsMonotonicAndCountsMicroseconds) {
  auto& clock = this->board().clock();
  const std::uint64_t start_us = clock.now_us();
  std::uint64_t last_us = start_us;
  for (int ms = 0; ms < 20; ++ms) {
    this->rig.pass_ms(1);
    ASSERT_GE(clock.now_us(), last_us);
    last_us = clock.now_us();
  }
  EXPECT_NEAR(static_cast<double>(last_us - start_us), 20000.0, 1000.0) << "one tick of slack";
}

TYPED_TEST_P(BoardContract, EncodersCountEachSideBySign) {
  this->rig.set_counts({100, -100});
  this->rig.turn({7, -9});
  const hal::EncoderCounts counts = this->board().encoders().read();
  EXPECT_EQ(counts.left, 107);
  EXPECT_EQ(counts.right, -109);
}

TYPED_TEST_P(BoardContract, EncodersWrapSoThatDifferencesStayExact) {
  constexpr std::int32_t kTop = std::numeric_limits<std::int32_t>::max();
  constexpr std::int32_t kBottom = std::numeric_limits<std::int32_t>::min();
  this->rig.set_counts({kTop - 2, kBottom + 2});
  this->rig.turn({5, -5});
  const hal::EncoderCounts counts = this->board().encoders().read();
  EXPECT_EQ(counts.left, kBottom + 2);
  EXPECT_EQ(counts.right, kTop - 2);
}

TYPED_TEST_P(BoardContract, ReadingEncodersDoesNotChangeThem) {
  this->rig.turn({3, 4});
  const hal::EncoderCounts first = this->board().encoders().read(), second = this->board().encoders().read();
  EXPECT_EQ(first.left, second.left);
  EXPECT_EQ(first.right, second.right);
}

TYPED_TEST_P(BoardContract, MotorsCoastAtPowerOn) { EXPECT_EQ(this->rig.bridge(), Bridge::coast); }

TYPED_TEST_P(BoardContract, EachMotorCallReplacesTheOneBefore) {
  auto& motors = this->board().motors();
  motors.drive({100, -200});
  EXPECT_EQ(this->rig.bridge(), Bridge::drive);
  EXPECT_EQ(this->rig.duty(), (hal::Duty{100, -200}));
  motors.brake();
  EXPECT_EQ(this->rig.bridge(), Bridge::brake);
  motors.drive({-300, 400});
  EXPECT_EQ(this->rig.bridge(), Bridge::drive);
  EXPECT_EQ(this->rig.duty(), (hal::Duty{-300, 400}));
  motors.coast();
  EXPECT_EQ(this->rig.bridge(), Bridge::coast);
  motors.coast();
  EXPECT_EQ(this->rig.bridge(), Bridge::coast) << "coasting twice is legal";
}

TYPED_TEST_P(BoardContract, FullDriveIsAcceptedInBothSenses) {
  this->board().motors().drive({32767, -32767});
  this->rig.pass_ms(1);
  EXPECT_EQ(this->rig.duty(), (hal::Duty{32767, -32767}));
}

TYPED_TEST_P(BoardContract, DriverFaultIsSeenForAsLongAsItLasts) {
  auto& motors = this->board().motors();
  EXPECT_FALSE(motors.fault());
  this->rig.set_driver_fault(true);
  EXPECT_TRUE(motors.fault());
  this->rig.set_driver_fault(false);
  EXPECT_FALSE(motors.fault());
}

TYPED_TEST_P(BoardContract, BatteryReadsTheMotorSupplyInMillivolts) {
  const std::int32_t supply_mV = this->board().battery().millivolts();
  EXPECT_GE(supply_mV, 10000) << "the driver chip's lower limit";
  EXPECT_LE(supply_mV, 47000) << "and its upper one";
}

TYPED_TEST_P(BoardContract, NameFitsItsMessageField) {
  const std::string_view name = this->board().system().name();
  EXPECT_GE(name.size(), 1U);
  EXPECT_LE(name.size(), 23U);
  EXPECT_TRUE(std::all_of(name.begin(), name.end(), [](char c) { return c >= ' ' && c <= '~'; })) << name;
}

TYPED_TEST_P(BoardContract, UniqueIdStaysAndNoOtherRobotHasIt) {
  const auto id = this->board().system().unique_id();
  EXPECT_EQ(id, this->board().system().unique_id());
  EXPECT_NE(id, this->rig.other_id());
  EXPECT_EQ(id, this->rig.restarted_id());
}

TYPED_TEST_P(BoardContract, RebootCoasts) {
  this->board().motors().drive({1000, 1000});
  this->board().system().reboot();
  EXPECT_EQ(this->rig.bridge(), Bridge::coast);
}

TYPED_TEST_P(BoardContract, EnteringTheBootloaderCoasts) {
  this->board().motors().drive({1000, 1000});
  if (!this->board().system().enter_bootloader()) GTEST_SKIP() << "this board has no bootloader";
  EXPECT_EQ(this->rig.bridge(), Bridge::coast);
}

TYPED_TEST_P(BoardContract, FirstStartIsAPowerOn) {
  EXPECT_EQ(this->board().system().reset_cause(), hal::ResetCause::power_on);
}

TYPED_TEST_P(BoardContract, FedWatchdogAndHeldTickLetTimeGoOn) {
  this->board().system().feed_watchdog();
  const std::uint64_t before_us = this->board().clock().now_us();
  { [[maybe_unused]] const auto guard = this->board().hold_tick(); }
  this->rig.pass_ms(2);
  EXPECT_GT(this->board().clock().now_us(), before_us);
}

REGISTER_TYPED_TEST_SUITE_P(BoardContract, ClockIsMonotonicAndCountsMicroseconds, EncodersCountEachSideBySign,
                            EncodersWrapSoThatDifferencesStayExact, ReadingEncodersDoesNotChangeThem,
                            MotorsCoastAtPowerOn, EachMotorCallReplacesTheOneBefore,
                            FullDriveIsAcceptedInBothSenses, DriverFaultIsSeenForAsLongAsItLasts,
                            BatteryReadsTheMotorSupplyInMillivolts, NameFitsItsMessageField,
                            UniqueIdStaysAndNoOtherRobotHasIt, RebootCoasts, EnteringTheBootloaderCoasts,
                            FirstStartIsAPowerOn, FedWatchdogAndHeldTickLetTimeGoOn);

}  // namespace astro::contract
