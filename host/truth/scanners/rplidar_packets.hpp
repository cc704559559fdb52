#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "host/base/bytes.hpp"

/// What a Slamtec RPLIDAR and its host say to each other, as bytes: the host's requests, the descriptor that comes before each
/// answer, and answers of which there is one. Measurements, which come without end, are in rplidar_nodes.hpp.
///
/// Source  "RPLIDAR interface protocol and application notes" of the maker, rev. 1.1 (A1, A2) and 2.x (A3, C1): the sections on
///         packets, GET_INFO, GET_HEALTH and GET_SAMPLERATE.
namespace astro::truth::rplidar {

enum class Command : std::uint8_t {
  scan = 0x20,
  stop = 0x25,
  reset = 0x40,
  get_info = 0x50,
  get_health = 0x52,
  get_sample_rate = 0x59,
  express_scan = 0x82,
  set_motor_pwm = 0xF0
};

/// What follows a descriptor.
enum class AnswerType : std::uint8_t {
  info = 0x04,
  health = 0x06,
  sample_rate = 0x15,
  nodes = 0x81,           // one measurement each
  capsules = 0x82,        // 32 measurements each
  dense_capsules = 0x85,  // 40 measurements each
};

/// A request as the host sends it; commands from 0x80 on have a payload, of at most 255 bytes.
Bytes request(Command command, ByteView payload = {});
/// The payload of express_scan: all zero, the mode that every model has.
inline constexpr std::array<std::uint8_t, 5> kExpressPayload{};

/// Takes the first whole request out of `received`, and what stands before it; nothing if there is none yet. For the scanner's
/// side. A request with a wrong checksum is dropped.
std::optional<Command> take_request(Bytes& received);

/// Announces an answer.
struct Descriptor {
  AnswerType type{};
  std::uint32_t bytes = 0;  // of one answer
  bool repeats = false;     // until the next request

  bool operator==(const Descriptor&) const = default;
};

inline constexpr std::size_t kDescriptorBytes = 7;
Bytes to_bytes(const Descriptor& descriptor);
/// The descriptor of this type in the bytes and where it ends, whatever stands before it; nothing if there is none, or not all.
struct FoundDescriptor {
  Descriptor descriptor;
  std::size_t end = 0;
};
std::optional<FoundDescriptor> find_descriptor(ByteView received, AnswerType type);

struct Info {
  static constexpr std::size_t kBytes = 20;

  std::uint8_t model = 0;  // the series in the upper four bits: 1 to 3 for A1 to A3, 4 for C1
  std::uint8_t firmware_minor = 0, firmware_major = 0, hardware = 0;
  std::array<std::uint8_t, 16> serial{};

  /// "A1M8": as the maker names it.
  std::string name() const;
  bool operator==(const Info&) const = default;
};

enum class HealthStatus : std::uint8_t { good = 0, warning = 1, error = 2 };

struct Health {
  static constexpr std::size_t kBytes = 3;

  HealthStatus status = HealthStatus::good;
  std::uint16_t code = 0;

  bool operator==(const Health&) const = default;
};

/// How long one measurement takes.
struct SampleTimes {
  static constexpr std::size_t kBytes = 4;

  std::uint16_t standard_us = 0, express_us = 0;

  bool operator==(const SampleTimes&) const = default;
};

Bytes to_bytes(const Info& info);
Bytes to_bytes(const Health& health);
Bytes to_bytes(const SampleTimes& times);

/// Precondition of all: as many bytes as the answer has.
Info info_in(ByteView answer);
Health health_in(ByteView answer);
SampleTimes sample_times_in(ByteView answer);

}  // namespace astro::truth::rplidar
