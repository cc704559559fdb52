#include "tests/target/usb/usb_fixture.hpp"

// The serial port on USB as a host sees it: requests of chapter 9 and of the class, and the bytes of the
// port.
namespace astro::emulator {
namespace {

INSTANTIATE_TEST_SUITE_P(FullAndHighSpeed, Usb, testing::Bool(), name_of_speed);

constexpr std::uint64_t kTick_us = 1000;  // telemetry tells of the last tick
constexpr std::uint16_t kInAddress = 0x84, kOutAddress = 0x03, kNotifyAddress = 0x82;

TEST_P(Usb, EnumeratesAsLinuxDoesIt) {
  EXPECT_EQ(descriptor(1, 0, 64).size(), 18U);
  host_.reset(GetParam());
  ASSERT_EQ(host_.set_address(kAddress), Outcome::done);
  EXPECT_EQ(descriptor(1, 0, 18).size(), 18U);
  EXPECT_EQ(descriptor(6, 0, 10).size(), 10U);
  const Bytes head = descriptor(2, 0, 9);
  ASSERT_EQ(head.size(), 9U);
  const auto total = static_cast<std::uint16_t>(head[2] | head[3] << 8);
  EXPECT_EQ(descriptor(2, 0, total).size(), total);
  for (const std::uint8_t text : Bytes{0, 2, 1, 3}) EXPECT_GE(descriptor(3, text, 255).size(), 4U);
  EXPECT_EQ(host_.write({0x00, 9, 1, 0, 0}), Outcome::done);
}

TEST_P(Usb, TakesItsAddressAfterTheStatusStageAndAnswersToNoOther) {
  ASSERT_EQ(host_.set_address(kAddress), Outcome::done);  // whose status stage is at address 0
  EXPECT_EQ(teensy_.usb().setup(0, {0x80, 6, 0, 1, 0, 0, 18, 0}), Handshake::nothing);
  EXPECT_EQ(descriptor(1, 0, 18).size(), 18U);
  EXPECT_EQ(host_.set_address(9), Outcome::done) << "a host may give another one";
  EXPECT_EQ(descriptor(1, 0, 18).size(), 18U);
}

TEST_P(Usb, TellsItsConfigurationAndLeavesItAgain) {
  ASSERT_EQ(host_.set_address(kAddress), Outcome::done);
  Bytes configuration;
  ASSERT_EQ(host_.read({0x80, 8, 0, 0, 1}, configuration), Outcome::done);
  EXPECT_EQ(configuration, Bytes{0});
  EXPECT_EQ(teensy_.usb().in(kAddress, kIn).handshake, Handshake::nothing) << "no endpoint but 0 yet";
  configure();
  ASSERT_EQ(host_.read({0x80, 8, 0, 0, 1}, configuration), Outcome::done);
  EXPECT_EQ(configuration, Bytes{1});
  EXPECT_EQ(host_.write({0x00, 9, 2, 0, 0}), Outcome::stalled) << "there is no second";
  ASSERT_EQ(host_.write({0x00, 9, 0, 0, 0}), Outcome::done);
  EXPECT_EQ(teensy_.usb().in(kAddress, kIn).handshake, Handshake::nothing);
  configure();
  open_port();
  EXPECT_TRUE(hello(13));
}

TEST_P(Usb, TellsTheStatusOfDeviceInterfacesAndEndpoints) {
  configure();
  Bytes status;
  ASSERT_EQ(host_.read({0x80, 0, 0, 0, 2}, status), Outcome::done);
  EXPECT_EQ(status, (Bytes{1, 0})) << "self-powered, no remote wake-up";
  ASSERT_EQ(host_.read({0x81, 0, 0, 1, 2}, status), Outcome::done);
  EXPECT_EQ(status, (Bytes{0, 0}));
  EXPECT_EQ(host_.read({0x81, 0, 0, 2, 2}, status), Outcome::stalled) << "there is no third interface";
  for (const std::uint16_t endpoint : {std::uint16_t{0}, kInAddress, kOutAddress, kNotifyAddress}) {
    ASSERT_EQ(host_.read({0x82, 0, 0, endpoint, 2}, status), Outcome::done) << endpoint;
    EXPECT_EQ(status, (Bytes{0, 0}));
  }
  EXPECT_EQ(host_.read({0x82, 0, 0, 0x85, 2}, status), Outcome::stalled);
}

TEST_P(Usb, HasOneSettingOfEachInterface) {
  configure();
  Bytes setting;
  ASSERT_EQ(host_.read({0x81, 10, 0, 1, 1}, setting), Outcome::done);
  EXPECT_EQ(setting, Bytes{0});
  EXPECT_EQ(host_.write({0x01, 11, 0, 1, 0}), Outcome::done);
  EXPECT_EQ(host_.write({0x01, 11, 1, 1, 0}), Outcome::stalled);
}

TEST_P(Usb, BeginsAnewWhenASettingIsChosen) {
  configure();
  open_port();
  EXPECT_TRUE(ask(protocol::Ping{}, 15));  // a packet each way: both toggles stand at 1
  ASSERT_EQ(host_.write({0x01, 11, 0, 1, 0}), Outcome::done);
  EXPECT_TRUE(hello(16)) << "from DATA0 on both sides";
}

TEST_P(Usb, DropsWhatIsUnderWayWhenItIsConfiguredAgain) {
  configure();
  open_port();
  ASSERT_TRUE(ask(protocol::SetTelemetry{1, protocol::Telemetry::kPose}, 17));
  teensy_.run_for(50ms);  // nobody reads
  ASSERT_EQ(host_.write({0x00, 9, 1, 0, 0}), Outcome::done);
  EXPECT_EQ(host_.receive(kIn, 20ms), std::nullopt) << "no program has opened the port since";
  open_port();
  EXPECT_TRUE(hello(18));
}

TEST_P(Usb, AnswersTheProtocolOnceAPortIsOpen) {
  configure();
  open_port();
  EXPECT_TRUE(hello(11));
  EXPECT_TRUE(hello(12));
}

TEST_P(Usb, KeepsLineCoding) {
  configure();
  const Bytes coding{0x00, 0xC2, 0x01, 0x00, 0, 0, 8};
  ASSERT_EQ(host_.write({0x21, 0x20, 0, 0, 7}, coding), Outcome::done);
  Bytes read;
  ASSERT_EQ(host_.read({0xA1, 0x21, 0, 0, 7}, read), Outcome::done);
  EXPECT_EQ(read, coding);
  EXPECT_EQ(host_.write({0x21, 0x20, 0, 0, 6}, Bytes(6, 0)), Outcome::stalled) << "it has seven bytes";
  EXPECT_EQ(host_.write({0x21, 0x20, 0, 1, 7}, coding), Outcome::stalled) << "the data interface has none";
  EXPECT_EQ(host_.write({0x21, 0x23, 100, 0, 0}), Outcome::done) << "a break means nothing";
}

TEST_P(Usb, StallsWhatItDoesNotKnowAndGoesOn) {
  configure();
  Bytes bytes;
  EXPECT_EQ(host_.read({0xC0, 0x55, 0, 0, 4}, bytes), Outcome::stalled);
  EXPECT_EQ(host_.read({0x80, 6, 0x0900, 0, 4}, bytes), Outcome::stalled);
  EXPECT_EQ(descriptor(1, 0, 18).size(), 18U);
}

TEST_P(Usb, DropsARequestThatTheHostThinksBetterOf) {
  configure();
  ASSERT_EQ(host_.setup_only({0x80, 6, 0x0200, 0, 75}), Handshake::ack);
  ASSERT_EQ(host_.setup_only({0x21, 0x20, 0, 0, 7}), Handshake::ack);
  EXPECT_EQ(descriptor(1, 0, 18).size(), 18U);
}

TEST_P(Usb, TellsTheLastStageOfARequestFromTheNextRequest) {
  configure();
  Bytes read;
  // GET_LINE_CODING, and SET_LINE_CODING before the firmware has heard of the former's status stage.
  ASSERT_EQ(host_.setup_only({0xA1, 0x21, 0, 0, 7}), Handshake::ack);
  ASSERT_EQ(teensy_.usb().in(kAddress, 0).bytes.size(), 7U);
  teensy_.run_for(1ms);
  ASSERT_EQ(teensy_.usb().out(kAddress, 0, {}, true), Handshake::ack);
  const Bytes coding{0x80, 0x25, 0, 0, 0, 0, 8};
  ASSERT_EQ(host_.write({0x21, 0x20, 0, 0, 7}, coding), Outcome::done);
  ASSERT_EQ(host_.read({0xA1, 0x21, 0, 0, 7}, read), Outcome::done);
  EXPECT_EQ(read, coding);
}

TEST_P(Usb, LeavesTheBusWhenItHasMissedAResetAndComesBack) {
  configure();
  open_port();
  teensy_.usb().begin_reset();
  teensy_.usb().end_reset(high_speed());  // over before the firmware has run
  teensy_.run_for(1ms);
  EXPECT_FALSE(teensy_.usb().attached()) << "so that the host forgets it";
  ASSERT_TRUE(teensy_.run_until([&] { return teensy_.usb().attached(); }, 500ms));
  host_.reset(high_speed());
  configure();
  open_port();
  EXPECT_TRUE(hello(22));
}

TEST_P(Usb, StaysOffTheBusAfterEveryStartUntilAnyHostHasNoticed) {
  constexpr double kHubIsAsked_ms = 256;
  const auto away_ms = [this] {
    const Cycles begun = teensy_.now();
    EXPECT_FALSE(teensy_.usb().attached());
    EXPECT_TRUE(teensy_.run_until([&] { return teensy_.usb().attached(); }, 500ms));
    return static_cast<double>(teensy_.now() - begun) / 600e3;
  };
  teensy_.press_reset();
  EXPECT_GT(away_ms(), kHubIsAsked_ms) << "the button";
  teensy_.power_cycle();
  EXPECT_GT(away_ms(), kHubIsAsked_ms) << "the supply: HalfKay may have been attached before";
  host_.reset(high_speed());
  configure();
  open_port();
  EXPECT_TRUE(hello(23));
}

TEST_P(Usb, ForgetsEverythingInABusResetInTheMiddleOfATransfer) {
  configure();
  open_port();
  ASSERT_EQ(host_.setup_only({0x80, 6, 0x0200, 0, 75}), Handshake::ack);
  ASSERT_TRUE(host_.send(kOut, frame(protocol::Hello{}, 5), 100ms));
  host_.reset(GetParam());
  EXPECT_EQ(descriptor(1, 0, 64).size(), 18U);
  EXPECT_EQ(teensy_.usb().in(0, kIn).handshake, Handshake::nothing) << "not configured any more";
  configure();
  open_port();
  EXPECT_TRUE(hello(21));
}

TEST_P(Usb, HaltsAndUnhaltsEachEndpoint) {
  configure();
  open_port();
  EXPECT_TRUE(ask(protocol::Ping{}, 30));  // a packet each way: both toggles stand at 1
  for (const std::uint16_t endpoint : {kInAddress, kOutAddress}) {
    ASSERT_EQ(host_.write({0x02, 3, 0, endpoint, 0}), Outcome::done);
    EXPECT_EQ(endpoint == kInAddress ? teensy_.usb().in(kAddress, kIn).handshake
                                     : teensy_.usb().out(kAddress, kOut, Bytes{0}, true),
              Handshake::stall);
    Bytes status;
    ASSERT_EQ(host_.read({0x82, 0, 0, endpoint, 2}, status), Outcome::done);
    EXPECT_EQ(status, (Bytes{1, 0}));
    ASSERT_EQ(host_.write({0x02, 1, 0, endpoint, 0}), Outcome::done);
    EXPECT_TRUE(hello(static_cast<std::uint16_t>(100 + endpoint))) << "from DATA0 on both sides";
  }
}

TEST_P(Usb, IsSilentWhileSuspendedAndTellsNothingOldAfterResume) {
  configure();
  open_port();
  ASSERT_TRUE(ask(protocol::SetTelemetry{1, protocol::Telemetry::kPose}, 41));
  host_.suspend();
  teensy_.run_for(100ms);
  const std::uint64_t resumed_us = teensy_.robot_clock_us();
  host_.resume();
  EXPECT_GE(time_of_first_telemetry_us() + kTick_us, resumed_us);
  EXPECT_TRUE(hello(42));
}

TEST_P(Usb, KeepsNothingForAPortThatNobodyHasOpen) {
  configure();
  ASSERT_TRUE(host_.send(kOut, frame(protocol::Hello{}, 51), 100ms));
  EXPECT_EQ(host_.receive(kIn, 50ms), std::nullopt);
  open_port();
  EXPECT_TRUE(hello(52));
}

TEST_P(Usb, TellsAProgramNothingThatWasMeantForTheLastOne) {
  configure();
  open_port();
  ASSERT_TRUE(ask(protocol::SetTelemetry{1, protocol::Telemetry::kPose}, 53));
  teensy_.run_for(50ms);  // the program hangs, and is killed
  close_port();
  EXPECT_EQ(host_.receive(kIn, 20ms), std::nullopt);
  const std::uint64_t opened_us = teensy_.robot_clock_us();
  open_port();
  EXPECT_GE(time_of_first_telemetry_us() + kTick_us, opened_us);
}

TEST_P(Usb, TakesATransferOfExactlyFullPacketsWithTheEmptyOneBehindItOrWithout) {
  configure();
  open_port();
  std::uint16_t request = 60;
  for (const std::size_t size : {bulk_packet(), 2 * bulk_packet(), 7 * bulk_packet()})
    for (const bool empty_packet : {true, false}) {
      Bytes bytes = frame(protocol::Hello{}, ++request);
      bytes.insert(bytes.begin(), size - bytes.size(), 0);  // zeros are the ends of frames without content
      ASSERT_TRUE(host_.send(kOut, bytes, 100ms));
      if (empty_packet) {
        ASSERT_TRUE(host_.send(kOut, {}, 100ms));
      }
      EXPECT_TRUE(answers(request)) << size << (empty_packet ? " with" : " without");
    }
}

TEST_P(Usb, EndsATransferOfExactlyFullPacketsByAnEmptyOne) {
  configure();
  open_port();
  ASSERT_TRUE(ask(protocol::SetTelemetry{1, protocol::Telemetry::kPose}, 71));
  teensy_.run_for(100ms);  // nobody reads
  // Telemetry leaves room for answers; with those more gathers than a transfer takes.
  for (std::uint16_t index = 0; index < 8; ++index)
    ASSERT_TRUE(host_.send(kOut, frame(protocol::GetParameterInfo{index}, 72 + index), 100ms));
  teensy_.run_for(10ms);
  std::size_t bytes = 0, full_transfers = 0;
  for (int packets = 0; packets < 60; ++packets) {
    const auto packet = host_.receive(kIn, 10ms);
    ASSERT_TRUE(packet && packet->handshake == Handshake::ack);
    bytes += packet->bytes.size();
    if (packet->bytes.size() == bulk_packet()) continue;
    if (packet->bytes.empty()) {
      EXPECT_EQ(bytes, 512U) << "nothing but a transfer of full packets needs one";
      ++full_transfers;
    } else {
      EXPECT_NE(bytes % bulk_packet(), 0U);
    }
    bytes = 0;
  }
  EXPECT_GE(full_transfers, 1U);
}

TEST_P(Usb, GoesOnWhenTheCableIsPulledAndPluggedInAgain) {
  configure();
  open_port();
  ASSERT_TRUE(ask(protocol::SetTelemetry{1, protocol::Telemetry::kPose}, 81));
  const std::uint64_t before_us = teensy_.robot_clock_us();
  teensy_.usb().unplug();
  teensy_.run_for(500ms);
  EXPECT_FALSE(teensy_.usb().attached());
  EXPECT_GE(teensy_.robot_clock_us() - before_us, 499'000U) << "the robot has not restarted";
  teensy_.usb().plug_in();
  ASSERT_TRUE(teensy_.usb().attached());
  host_.reset(GetParam());
  configure();
  EXPECT_EQ(host_.receive(kIn, 20ms), std::nullopt) << "nothing is left of what nobody could read";
  open_port();
  EXPECT_TRUE(hello(82));
}

TEST_P(Usb, StopsDrivingWhenTheCableIsPulled) {
  configure();
  open_port();
  teensy_.run_for(50ms);  // through boot
  ASSERT_TRUE(ask(protocol::Arm{}, 91));
  ASSERT_TRUE(ask(protocol::Velocity{200'000, 0}, 92));
  teensy_.run_for(200ms);
  ASSERT_FALSE(outputs_off()) << "it drives";
  teensy_.usb().unplug();
  teensy_.run_for(1s);  // the command time-out of 0.3 s and the ramp
  EXPECT_TRUE(outputs_off());
}

TEST_P(Usb, AHostThatSets134BaudGetsTheBootLoaderOfARobotAtRest) {
  configure();
  ASSERT_EQ(set_baud(134), Outcome::done);
  EXPECT_TRUE(teensy_.run_until([&] { return teensy_.in_bootloader(); }, 500ms));
  EXPECT_TRUE(outputs_off());
}

TEST_P(Usb, AnArmedRobotPays134BaudNoHeed) {
  configure();
  open_port();
  teensy_.run_for(50ms);  // through boot
  ASSERT_TRUE(ask(protocol::Arm{}, 95));
  ASSERT_EQ(set_baud(134), Outcome::done);
  teensy_.run_for(500ms);
  EXPECT_FALSE(teensy_.in_bootloader());
  ASSERT_TRUE(ask(protocol::Disarm{}, 96));
  teensy_.run_for(500ms);
  EXPECT_FALSE(teensy_.in_bootloader()) << "nor later: it was asked when it could not";
  ASSERT_EQ(set_baud(134), Outcome::done);
  EXPECT_TRUE(teensy_.run_until([&] { return teensy_.in_bootloader(); }, 500ms)) << "asked again";
}

}  // namespace
}  // namespace astro::emulator
