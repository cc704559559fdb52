#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "common/protocol/codec.hpp"
#include "common/protocol/framer.hpp"
#include "common/protocol/messages.hpp"
#include "host/emulator/robot/usb_host.hpp"

namespace astro::emulator {

using namespace std::chrono_literals;
using Outcome = UsbHost::Outcome;
using Bytes = std::vector<std::uint8_t>;

/// The image that users flash, attached to a USB host at full speed and at high speed.
class Usb : public testing::TestWithParam<bool> {
 protected:
  static constexpr int kOut = 3, kIn = 4;
  static constexpr std::uint8_t kAddress = 7;

  void SetUp() override {
    ASSERT_TRUE(
        teensy_.run_until([&] { return teensy_.usb().attached(); }, 500ms));  // it stays away at first
    host_.reset(GetParam());
  }

  bool high_speed() const { return GetParam(); }
  std::size_t bulk_packet() const { return high_speed() ? 512 : 64; }

  Bytes descriptor(std::uint8_t type, std::uint8_t number, std::uint16_t length) {
    Bytes bytes;
    EXPECT_EQ(host_.read({0x80, 6, static_cast<std::uint16_t>(type << 8 | number), 0, length}, bytes),
              Outcome::done)
        << "type " << int{type};
    return bytes;
  }
  void configure() {
    ASSERT_EQ(host_.set_address(kAddress), Outcome::done);
    ASSERT_EQ(host_.write({0x00, 9, 1, 0, 0}), Outcome::done);
  }
  void open_port() { ASSERT_EQ(host_.write({0x21, 0x22, 3, 0, 0}), Outcome::done); }
  void close_port() { ASSERT_EQ(host_.write({0x21, 0x22, 0, 0, 0}), Outcome::done); }
  Outcome set_baud(std::uint32_t baud) {
    return host_.write({0x21, 0x20, 0, 0, 7},
                       Bytes{static_cast<std::uint8_t>(baud), static_cast<std::uint8_t>(baud >> 8),
                             static_cast<std::uint8_t>(baud >> 16), 0, 0, 0, 8});
  }

  bool outputs_off() {
    const World::Bridges bridges = teensy_.world().bridges();
    return bridges.open[0] && bridges.open[1];
  }

  template <class M>
  Bytes frame(const M& message, std::uint16_t request) {
    std::array<std::uint8_t, protocol::kMaxBody> body{};
    std::array<std::uint8_t, protocol::kMaxFrame> out{};
    const std::size_t size = protocol::encode(message, request, body);
    const auto framed = std::span(out).first(protocol::encode_frame(std::span(body).first(size), out));
    return {framed.begin(), framed.end()};
  }
  /// True if the robot answers the request; what else it sends meanwhile is passed over.
  bool answers(std::uint16_t request) {
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
  template <class M>
  bool ask(const M& message, std::uint16_t request) {
    EXPECT_TRUE(host_.send(kOut, frame(message, request), 100ms));
    return answers(request);
  }
  /// The robot's time in the first telemetry that comes now; 0 if something else comes before.
  std::uint64_t time_of_first_telemetry_us() {
    protocol::Framer framer;
    for (int packets = 0; packets < 50; ++packets) {
      const auto packet = host_.receive(kIn, 100ms);
      if (!packet || packet->handshake != Handshake::ack) return 0;
      for (const std::uint8_t byte : packet->bytes)
        if (const auto body = framer.push(byte)) {
          const auto telemetry = protocol::decode<protocol::Telemetry>(*body);
          return telemetry && framer.counts().bad() == 0 ? telemetry->device_time_us : 0;
        }
    }
    return 0;
  }
  bool hello(std::uint16_t request) { return ask(protocol::Hello{}, request); }

  Teensy teensy_{ASTRO_IMAGE_DIR "/astrolabe-teensy40.hex"};
  UsbHost host_{teensy_};
};

inline std::string name_of_speed(const testing::TestParamInfo<bool>& high) {
  return high.param ? "High" : "Full";
}

}  // namespace astro::emulator
