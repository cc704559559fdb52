#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// The USB descriptors of the robot: a serial port of the class for communication devices (CDC-ACM), at full and, where
/// the board has it, at high speed.
///
/// Source  USB 2.0, chapter 9; CDC 1.2 and its PSTN subclass; the descriptor of associated interfaces (IAD).
namespace astro::usb_device {

inline constexpr std::uint8_t kNotifyEndpoint = 2, kOutEndpoint = 3, kInEndpoint = 4;
inline constexpr std::uint16_t kControlPacket = 64, kNotifyPacket = 16;

enum class Speed : std::uint8_t { full, high };
constexpr std::uint16_t bulk_packet(Speed speed) { return speed == Speed::high ? 512 : 64; }

enum class DescriptorType : std::uint8_t {
  device = 1,
  configuration = 2,
  string = 3,
  qualifier = 6,
  other_speed = 7,
};

constexpr std::uint8_t low(std::uint16_t word) { return static_cast<std::uint8_t>(word); }
constexpr std::uint8_t high(std::uint16_t word) { return static_cast<std::uint8_t>(word >> 8); }

/// What differs between devices.
struct Identity {
  std::uint16_t vendor = 0, product = 0;
  std::uint16_t release = 0;    // of the device, binary-coded decimal
  Speed fastest = Speed::full;  // a device without high speed has no descriptors about it (USB 2.0, 9.6.2)
};

constexpr std::array<std::uint8_t, 18> device(const Identity& identity) {
  return {
      18,
      1,  // length, device
      0x00,
      0x02,  // USB 2.0
      0xEF,
      0x02,
      0x01,            // class: several functions, described by IAD
      kControlPacket,  // of endpoint 0
      low(identity.vendor),
      high(identity.vendor),
      low(identity.product),
      high(identity.product),
      low(identity.release),
      high(identity.release),
      1,
      2,
      3,  // strings: manufacturer, product, serial number
      1,  // configurations
  };
}

/// The same at the other speed.
inline constexpr std::array<std::uint8_t, 10> kQualifier{10,   6,    0x00,           0x02, 0xEF,
                                                         0x02, 0x01, kControlPacket, 1,    0};

inline constexpr std::size_t kConfigurationBytes = 75;

constexpr std::array<std::uint8_t, kConfigurationBytes> configuration(Speed speed, DescriptorType type) {
  const std::uint16_t bulk = bulk_packet(speed);
  const std::uint8_t notify_interval = speed == Speed::high ? 5 : 16;  // 2 ms; 16 ms
  return {
      9,
      static_cast<std::uint8_t>(type),
      kConfigurationBytes,
      0,
      2,
      1,
      0,
      0xC0,
      50,  // own supply, 100 mA of the bus
      8,
      0x0B,
      0,
      2,
      0x02,
      0x02,
      0x01,
      0,  // interfaces 0 and 1 belong together
      9,
      4,
      0,
      0,
      1,
      0x02,
      0x02,
      0x01,
      0,  // interface 0: communication
      5,
      0x24,
      0x00,
      0x10,
      0x01,  // CDC 1.10
      5,
      0x24,
      0x01,
      0x00,
      1,  // calls are not the device's to manage
      4,
      0x24,
      0x02,
      0x06,  // line coding, line state, break
      5,
      0x24,
      0x06,
      0,
      1,  // interface 0 leads interface 1
      7,
      5,
      0x80 | kNotifyEndpoint,
      0x03,
      low(kNotifyPacket),
      high(kNotifyPacket),
      notify_interval,
      9,
      4,
      1,
      0,
      2,
      0x0A,
      0x00,
      0x00,
      0,  // interface 1: data
      7,
      5,
      kOutEndpoint,
      0x02,
      low(bulk),
      high(bulk),
      0,
      7,
      5,
      0x80 | kInEndpoint,
      0x02,
      low(bulk),
      high(bulk),
      0,
  };
}

inline constexpr std::array<std::uint8_t, 4> kLanguages{4, 3, 0x09, 0x04};  // English

inline constexpr std::string_view kManufacturer = "Astrolabe", kProduct = "Differential-drive robot";
inline constexpr std::size_t kStringBytes = 2 + 2 * 32;  // the longest: a serial number of 32 digits

/// The robot's unique id as USB shows it: 32 hexadecimal digits.
constexpr std::array<char, 32> serial_number(const std::array<std::uint8_t, 16>& id) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::array<char, 32> text{};
  for (std::size_t i = 0; i < id.size(); ++i) {
    text[2 * i] = kDigits[id[i] >> 4];
    text[2 * i + 1] = kDigits[id[i] & 15];
  }
  return text;
}

/// A text as a string descriptor: UTF-16. Longer ones are cut.
struct StringDescriptor {
  std::array<std::uint8_t, kStringBytes> bytes{};
  std::size_t size = 2;

  constexpr explicit StringDescriptor(std::string_view text) {
    for (const char letter : text) {
      if (size + 2 > bytes.size()) break;
      bytes[size] = static_cast<std::uint8_t>(letter);
      size += 2;
    }
    bytes[0] = static_cast<std::uint8_t>(size);
    bytes[1] = static_cast<std::uint8_t>(DescriptorType::string);
  }
};

}  // namespace astro::usb_device
