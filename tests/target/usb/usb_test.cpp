#include <gtest/gtest.h>

#include "common/protocol/codec.hpp"
#include "common/protocol/framer.hpp"
#include "common/protocol/messages.hpp"
#include "hal/teensy40/usb/descriptors.hpp"
#include "host/emulator/usb/host.hpp"

namespace astro::emulator {
namespace {

using namespace std::chrono_literals;
using Outcome = UsbHost::Outcome;
using Bytes = std::vector<std::uint8_t>;
namespace device = teensy40::usb_device;

constexpr const char* kImage = ASTRO_IMAGE_DIR "/astrolabe-teensy40.hex";
constexpr int kOut = 3, kIn = 4;
constexpr std::uint16_t kInAddress = 0x84;

class Usb : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(teensy_.run_until([&] { return teensy_.usb().attached(); }, 100ms));
    host_.reset(GetParam());
  }
  Bytes descriptor(std::uint8_t type, std::uint8_t number, std::uint16_t length) {
    Bytes bytes;
    EXPECT_EQ(host_.read({0x80, 6, static_cast<std::uint16_t>(type << 8 | number), 0, length}, bytes),
              Outcome::done)
        << "type " << int{type};
    return bytes;
  }
  void configure() {
    ASSERT_EQ(host_.set_address(7), Outcome::done);
    ASSERT_EQ(host_.write({0x00, 9, 1, 0, 0}), Outcome::done);
  }
  void open_port() { ASSERT_EQ(host_.write({0x21, 0x22, 3, 0, 0}), Outcome::done); }

  Bytes frame(std::uint16_t request) {
    std::array<std::uint8_t, protocol::kMaxBody> body{};
    std::array<std::uint8_t, protocol::kMaxFrame> out{};
    const std::size_t size = protocol::encode(protocol::Hello{}, request, body);
    const auto framed = std::span(out).first(protocol::encode_frame(std::span(body).first(size), out));
    return {framed.begin(), framed.end()};
  }
  /// True if the robot answers a Hello.
  bool hello(std::uint16_t request) {
    EXPECT_TRUE(host_.send(kOut, frame(request), 100ms));
    protocol::Framer framer;
    for (int packets = 0; packets < 50; ++packets) {
      const auto packet = host_.receive(kIn, 100ms);
      if (!packet || packet->handshake != Handshake::ack) return false;
      for (const std::uint8_t byte : packet->bytes)
        if (const auto body = framer.push(byte))
          if (const auto header = protocol::peek(*body); header && header->request_id == request) return true;
    }
    return false;
  }

  Teensy teensy_{kImage};
  UsbHost host_{teensy_};
};

std::string name_of_speed(const testing::TestParamInfo<bool>& high) { return high.param ? "High" : "Full"; }
INSTANTIATE_TEST_SUITE_P(FullAndHighSpeed, Usb, testing::Bool(), name_of_speed);

TEST_P(Usb, EnumeratesAsLinuxDoesIt) {
  EXPECT_EQ(descriptor(1, 0, 64).size(), 18U);
  host_.reset(GetParam());
  ASSERT_EQ(host_.set_address(7), Outcome::done);
  EXPECT_EQ(descriptor(1, 0, 18), Bytes(device::kDevice.begin(), device::kDevice.end()));
  EXPECT_EQ(descriptor(6, 0, 10).size(), 10U);
  const Bytes head = descriptor(2, 0, 9);
  ASSERT_EQ(head.size(), 9U);
  EXPECT_EQ(descriptor(2, 0, static_cast<std::uint16_t>(head[2] | head[3] << 8)).size(), 75U);
  for (const std::uint8_t text : Bytes{0, 2, 1, 3}) EXPECT_GE(descriptor(3, text, 255).size(), 4U);
  EXPECT_EQ(host_.write({0x00, 9, 1, 0, 0}), Outcome::done);
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
}

TEST_P(Usb, StallsWhatItDoesNotKnowAndGoesOn) {
  configure();
  Bytes bytes;
  EXPECT_EQ(host_.read({0xC0, 0x55, 0, 0, 4}, bytes), Outcome::stalled);
  EXPECT_EQ(host_.read({0x80, 6, 0x0900, 0, 4}, bytes), Outcome::stalled);
  EXPECT_EQ(descriptor(1, 0, 18).size(), 18U);
}

TEST_P(Usb, ForgetsEverythingInABusResetInTheMiddleOfATransfer) {
  configure();
  open_port();
  ASSERT_EQ(host_.setup_only({0x80, 6, 0x0200, 0, 75}), Handshake::ack);
  ASSERT_TRUE(host_.send(kOut, frame(5), 100ms));
  host_.reset(GetParam());
  EXPECT_EQ(descriptor(1, 0, 64).size(), 18U);
  EXPECT_EQ(teensy_.usb().in(0, kIn).handshake, Handshake::nothing) << "not configured any more";
  configure();
  open_port();
  EXPECT_TRUE(hello(21));
}

TEST_P(Usb, HaltsAndUnhaltsAnEndpoint) {
  configure();
  open_port();
  ASSERT_EQ(host_.write({0x02, 3, 0, kInAddress, 0}), Outcome::done);
  EXPECT_EQ(teensy_.usb().in(7, kIn).handshake, Handshake::stall);
  Bytes status;
  ASSERT_EQ(host_.read({0x82, 0, 0, kInAddress, 2}, status), Outcome::done);
  EXPECT_EQ(status, (Bytes{1, 0}));
  ASSERT_EQ(host_.write({0x02, 1, 0, kInAddress, 0}), Outcome::done);
  EXPECT_TRUE(hello(31));
}

TEST_P(Usb, GoesOnAfterSuspendAndResume) {
  configure();
  open_port();
  host_.suspend();
  host_.resume();
  EXPECT_TRUE(hello(41));
}

TEST_P(Usb, KeepsNothingForAPortThatNobodyHasOpen) {
  configure();
  ASSERT_TRUE(host_.send(kOut, frame(51), 100ms));
  EXPECT_EQ(host_.receive(kIn, 50ms), std::nullopt);
  open_port();
  EXPECT_TRUE(hello(52));
}

}  // namespace
}  // namespace astro::emulator
