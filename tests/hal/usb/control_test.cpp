#include "hal/usb/control.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string_view>
#include <vector>

namespace astro::usb_device {
namespace {

using Kind = Response::Kind;
using Bytes = std::vector<std::uint8_t>;

// tests/target/usb sees a host's side of this; here stands what only the controller sees.
class Endpoint0 : public testing::Test {
 protected:
  static constexpr Identity kFast{0x16C0, 0x0483, 0x0279, Speed::high};
  Endpoint0() { control_.start(kFast, kSerialNumber); }
  Response ask(const usb_device::Setup& setup) { return control_.on_setup(setup, Speed::high); }
  void configure() {
    ask({0x00, 9, 1, 0, 0});
    control_.take_changes();
  }
  void set_line_state(std::uint16_t state) { ask({0x21, 0x22, state, 0, 0}); }

  static constexpr std::string_view kSerialNumber = "0123456789abcdef0123456789abcdef";
  Control control_;
};

TEST_F(Endpoint0, TellsOfEachChangeOnce) {
  EXPECT_EQ(ask({0x00, 5, 7, 0, 0}).kind, Kind::acknowledge);
  EXPECT_TRUE(control_.take_changes().address);
  EXPECT_EQ(control_.address(), 7);
  EXPECT_FALSE(control_.take_changes().address);
}

TEST_F(Endpoint0, EndpointsBeginAnewWithAConfigurationAndWithASetting) {
  ask({0x00, 9, 1, 0, 0});
  EXPECT_TRUE(control_.take_changes().endpoints);
  ask({0x01, 11, 0, 1, 0});
  EXPECT_TRUE(control_.take_changes().endpoints);
}

TEST_F(Endpoint0, APortIsClosedOnlyByWhoHadItOpen) {
  configure();
  set_line_state(0);
  EXPECT_FALSE(control_.take_changes().closed);
  set_line_state(3);
  EXPECT_TRUE(control_.listening());
  EXPECT_FALSE(control_.take_changes().closed);
  set_line_state(2);
  EXPECT_FALSE(control_.listening());
  EXPECT_TRUE(control_.take_changes().closed);
}

TEST_F(Endpoint0, LineCodingChangesOnlyWithAllItsBytes) {
  configure();
  ASSERT_EQ(ask({0x21, 0x20, 0, 0, 7}).kind, Kind::receive);
  control_.on_data(Bytes{134, 0, 0, 0, 0, 0});
  EXPECT_EQ(control_.line_coding().baud, 115'200U);
  control_.on_data(Bytes{134, 0, 0, 0, 0, 0, 8});
  EXPECT_EQ(control_.line_coding().baud, 134U);
}

TEST_F(Endpoint0, ABusResetForgetsAddressConfigurationHaltsAndThePort) {
  configure();
  ask({0x00, 5, 7, 0, 0});
  ask({0x02, 3, 0, 0x84, 0});
  set_line_state(3);
  control_.on_reset();
  EXPECT_EQ(control_.address(), 0);
  EXPECT_FALSE(control_.configured());
  EXPECT_FALSE(control_.listening());
  EXPECT_FALSE(control_.halted(0x84));
  const Control::Changes changes = control_.take_changes();
  EXPECT_FALSE(changes.address || changes.endpoints || changes.closed || changes.halted != 0);
}

TEST_F(Endpoint0, ADeviceWithoutHighSpeedHasNoDescriptorsAboutIt) {
  constexpr std::uint16_t kQualifier = 0x0600, kOtherSpeed = 0x0700;
  for (const std::uint16_t descriptor : {kQualifier, kOtherSpeed})
    EXPECT_EQ(ask({0x80, 6, descriptor, 0, 255}).kind, Kind::send);
  control_.start({0x2E8A, 0x000A, 0x0100, Speed::full}, kSerialNumber);
  for (const std::uint16_t descriptor : {kQualifier, kOtherSpeed})
    EXPECT_EQ(ask({0x80, 6, descriptor, 0, 255}).kind, Kind::stall);
}

TEST_F(Endpoint0, TellsTheBoardsOwnNumbers) {
  const Response device = ask({0x80, 6, 0x0100, 0, 18});
  EXPECT_EQ(Bytes(device.data.begin() + 8, device.data.begin() + 14),
            (Bytes{0xC0, 0x16, 0x83, 0x04, 0x79, 0x02}));
}

TEST(SerialNumber, ShowsEachByteOfTheIdInOrder) {
  constexpr std::array<std::uint8_t, 16> kId{0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF};
  const auto text = serial_number(kId);
  EXPECT_EQ(std::string_view(text.data(), text.size()), "0123456789ABCDEF0000000000000000");
}

TEST_F(Endpoint0, NoRequestWhateverMakesItSendMoreThanItIsAskedFor) {
  constexpr unsigned kSeed = 20260101;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<std::uint32_t> word;
  int answered = 0;
  for (int i = 0; i < 500'000; ++i) {
    usb_device::Setup setup = make_setup(word(random), word(random));
    setup.type &= 0xE3;  // recipients, requests and descriptors that exist, more often than not
    setup.request &= 0x2B;
    if (i % 2 == 0) {
      setup.value &= 0x0303;
      setup.index &= 0x0087;
    }
    const Response response = ask(setup);
    ASSERT_LE(response.data.size(), setup.length);
    ASSERT_TRUE(response.kind != Kind::send || setup.to_host());
    ASSERT_TRUE(response.kind != Kind::receive || (!setup.to_host() && response.length == setup.length));
    answered += response.kind != Kind::stall ? 1 : 0;
  }
  EXPECT_GT(answered, 1000) << "or this has tried nothing";
}

}  // namespace
}  // namespace astro::usb_device
