#include <gmock/gmock.h>

#include <set>

#include "tests/target/usb/usb_fixture.hpp"

// What the robot says of itself, byte by byte against the rules of USB 2.0 chapter 9, of CDC 1.2 with its
// PSTN subclass, and of the descriptor of associated interfaces.
namespace astro::emulator {
namespace {

class Descriptors : public Usb {};
INSTANTIATE_TEST_SUITE_P(FullAndHighSpeed, Descriptors, testing::Bool(), name_of_speed);

constexpr std::uint8_t kDevice = 1, kConfiguration = 2, kString = 3, kInterface = 4, kEndpoint = 5,
                       kQualifier = 6, kOtherSpeed = 7, kAssociation = 11, kClassInterface = 0x24;

std::uint16_t u16(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes.at(at) | bytes.at(at + 1) << 8);
}

/// The descriptors one after the other; all bytes of `all` are part of one.
std::vector<Bytes> split(const Bytes& all) {
  std::vector<Bytes> parts;
  for (std::size_t at = 0; at < all.size(); at += parts.back().size()) {
    const std::size_t length = all[at];
    EXPECT_GE(length, 2U) << "at byte " << at;
    EXPECT_LE(at + length, all.size()) << "at byte " << at;
    if (length < 2 || at + length > all.size()) break;
    parts.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(at),
                       all.begin() + static_cast<std::ptrdiff_t>(at + length));
  }
  return parts;
}

TEST_P(Descriptors, OfTheDevice) {
  const Bytes device = descriptor(kDevice, 0, 255);
  ASSERT_EQ(device.size(), 18U);
  EXPECT_EQ(device[0], 18) << "bLength";
  EXPECT_EQ(device[1], kDevice);
  EXPECT_EQ(u16(device, 2), 0x0200) << "bcdUSB: a device that knows high speed is at least 2.0";
  EXPECT_THAT(Bytes(device.begin() + 4, device.begin() + 7), testing::ElementsAre(0xEF, 0x02, 0x01))
      << "the class that associations of interfaces ask for";
  EXPECT_EQ(device[7], 64) << "bMaxPacketSize0: must be 64 at high speed";
  EXPECT_EQ(u16(device, 8), 0x16C0) << "the Teensy's vendor";
  EXPECT_EQ(u16(device, 10), 0x0483) << "a serial port of the Teensy's";
  for (const std::size_t text : {14U, 15U, 16U})
    EXPECT_GT(descriptor(kString, device[text], 255).size(), 2U) << "string of byte " << text;
  EXPECT_EQ(device[17], 1) << "bNumConfigurations";
}

TEST_P(Descriptors, QualifierTellsOfTheOtherSpeedWhatTheDeviceTells) {
  const Bytes device = descriptor(kDevice, 0, 18), qualifier = descriptor(kQualifier, 0, 255);
  ASSERT_EQ(qualifier.size(), 10U);
  EXPECT_EQ(qualifier[0], 10);
  EXPECT_EQ(qualifier[1], kQualifier);
  EXPECT_EQ(Bytes(qualifier.begin() + 2, qualifier.begin() + 8),
            Bytes(device.begin() + 2, device.begin() + 8))
      << "version, class, packet";
  EXPECT_EQ(qualifier[8], device[17]) << "as many configurations";
  EXPECT_EQ(qualifier[9], 0) << "reserved";
}

/// Holds each byte of a configuration to its rule.
void check_configuration(const Bytes& all, bool high_speed) {
  ASSERT_EQ(u16(all, 2), all.size()) << "wTotalLength";
  const std::vector<Bytes> parts = split(all);
  ASSERT_EQ(parts.size(), 11U);

  const Bytes& configuration = parts[0];
  ASSERT_EQ(configuration.size(), 9U);
  EXPECT_EQ(configuration[4], 2) << "bNumInterfaces";
  EXPECT_GE(configuration[5], 1) << "bConfigurationValue: 0 would mean not configured";
  EXPECT_EQ(configuration[6], 0) << "iConfiguration: no string";
  EXPECT_EQ(configuration[7] & 0x9F, 0x80) << "bmAttributes: bit 7 is one, bits 0 to 4 are zero";
  EXPECT_LE(configuration[8], 250) << "bMaxPower: at most 500 mA";

  EXPECT_EQ(parts[1], (Bytes{8, kAssociation, 0, 2, 0x02, 0x02, 0x01, 0}))
      << "interfaces 0 and 1 belong together, class and protocol of the first";
  EXPECT_EQ(parts[2], (Bytes{9, kInterface, 0, 0, 1, 0x02, 0x02, 0x01, 0}))
      << "interface 0: communication, abstract control model, one endpoint";
  EXPECT_EQ(parts[3], (Bytes{5, kClassInterface, 0x00, 0x10, 0x01})) << "header first, class CDC 1.10";
  EXPECT_EQ(parts[4], (Bytes{5, kClassInterface, 0x01, 0x01, 1})) << "calls are managed over interface 1";
  EXPECT_EQ(parts[5], (Bytes{4, kClassInterface, 0x02, 0x06})) << "knows line coding, line state and break";
  EXPECT_EQ(parts[6], (Bytes{5, kClassInterface, 0x06, 0, 1})) << "interface 0 leads interface 1";
  EXPECT_EQ(parts[8], (Bytes{9, kInterface, 1, 0, 2, 0x0A, 0x00, 0x00, 0})) << "interface 1: data";

  std::set<std::uint8_t> addresses;
  for (const std::size_t i : {7U, 9U, 10U}) {
    const Bytes& endpoint = parts[i];
    ASSERT_EQ(endpoint.size(), 7U);
    EXPECT_EQ(endpoint[1], kEndpoint);
    EXPECT_TRUE(addresses.insert(endpoint[2]).second) << "each address once";
    EXPECT_NE(endpoint[2] & 0x0F, 0) << "endpoint 0 is nobody's";
    EXPECT_EQ(endpoint[2] & 0x70, 0) << "reserved";
  }
  const Bytes &notify = parts[7], &out = parts[9], &in = parts[10];
  EXPECT_EQ(notify[3], 3) << "interrupt";
  EXPECT_TRUE((notify[2] & 0x80) != 0 && (in[2] & 0x80) != 0 && (out[2] & 0x80) == 0) << "directions";
  EXPECT_LE(u16(notify, 4), high_speed ? 1024 : 64);
  EXPECT_GE(notify[6], 1) << "bInterval";
  EXPECT_LE(notify[6], high_speed ? 16 : 255) << "an exponent at high speed, milliseconds at full speed";
  for (const Bytes& bulk : {out, in}) {
    EXPECT_EQ(bulk[3], 2) << "bulk";
    EXPECT_EQ(u16(bulk, 4), high_speed ? 512 : 64) << "at high speed nothing but 512 is allowed";
    EXPECT_EQ(bulk[6], 0) << "bInterval: no limit of NAKs";
  }
}

TEST_P(Descriptors, OfTheConfiguration) {
  const Bytes all = descriptor(kConfiguration, 0, 255);
  ASSERT_EQ(all[1], kConfiguration);
  check_configuration(all, high_speed());
}

TEST_P(Descriptors, OfTheConfigurationAtTheOtherSpeed) {
  const Bytes all = descriptor(kOtherSpeed, 0, 255);
  ASSERT_EQ(all[1], kOtherSpeed);
  check_configuration(all, !high_speed());
  host_.reset(!high_speed());
  Bytes there = descriptor(kConfiguration, 0, 255);
  there[1] = kOtherSpeed;
  EXPECT_EQ(all, there) << "it is what the device says when it runs at that speed";
}

TEST_P(Descriptors, StringsAreEnglishAndTheSerialNumberIsTheRobotsId) {
  EXPECT_EQ(descriptor(kString, 0, 255), (Bytes{4, kString, 0x09, 0x04}));
  const auto text = [&](std::uint8_t number) {
    const Bytes bytes = descriptor(kString, number, 255);
    EXPECT_EQ(bytes[0], bytes.size());
    EXPECT_EQ(bytes[1], kString);
    EXPECT_EQ(bytes.size() % 2, 0U) << "UTF-16";
    std::string plain;
    for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) plain += static_cast<char>(u16(bytes, i));
    return plain;
  };
  EXPECT_EQ(text(1), "Astrolabe");
  EXPECT_EQ(text(2), "Differential-drive robot");
  EXPECT_THAT(text(3), testing::MatchesRegex("[0-9a-fA-F]{32}"));
  Bytes none;
  EXPECT_EQ(host_.read({0x80, 6, kString << 8 | 4, 0, 255}, none), Outcome::stalled) << "there is no fourth";
}

TEST_P(Descriptors, ComeAsFarAsTheHostAsks) {
  const Bytes all = descriptor(kConfiguration, 0, 255);
  for (const std::uint16_t length : std::vector<std::uint16_t>{1, 8, 9, 63, 64, 65, 74, 75}) {
    const Bytes part = descriptor(kConfiguration, 0, length);
    EXPECT_EQ(part, Bytes(all.begin(), all.begin() + length)) << length;
  }
}

}  // namespace
}  // namespace astro::emulator
