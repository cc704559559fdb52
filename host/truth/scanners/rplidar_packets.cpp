#include "host/truth/scanners/rplidar_packets.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace astro::truth::rplidar {
namespace {

constexpr std::uint8_t kRequestStart = 0xA5, kAnswerStart1 = 0xA5, kAnswerStart2 = 0x5A;
constexpr std::uint8_t kHasPayload = 0x80;
constexpr std::uint32_t kLengthBits = 30, kLengthMask = (1U << kLengthBits) - 1;

std::uint8_t xor_of(ByteView bytes) {
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : bytes) sum = static_cast<std::uint8_t>(sum ^ byte);
  return sum;
}

/// The size of the request that these bytes begin with; nothing if more bytes must come before it is known.
std::optional<std::size_t> size_of_request(ByteView bytes) {
  if (bytes.size() < 2) return std::nullopt;
  if ((bytes[1] & kHasPayload) == 0) return 2;
  if (bytes.size() < 3) return std::nullopt;
  return 3U + bytes[2] + 1U;
}

Descriptor descriptor_at(ByteView bytes) {
  const auto length = load<std::uint32_t>(bytes, 2);
  return {static_cast<AnswerType>(bytes[6]), length & kLengthMask, length >> kLengthBits != 0};
}

}  // namespace

Bytes request(Command command, ByteView payload) {
  Bytes bytes;
  append(bytes, kRequestStart);
  append(bytes, static_cast<std::uint8_t>(command));
  if ((bytes[1] & kHasPayload) == 0) return bytes;
  bytes.push_back(static_cast<std::uint8_t>(payload.size()));
  append(bytes, payload);
  bytes.push_back(xor_of(bytes));
  return bytes;
}

std::optional<Command> take_request(Bytes& received) {
  while (true) {
    received.erase(received.begin(), std::ranges::find(received, kRequestStart));
    const auto size = size_of_request(received);
    if (!size || received.size() < *size) return std::nullopt;
    const ByteView whole(received.data(), *size);
    const bool good = (whole[1] & kHasPayload) == 0 || xor_of(whole) == 0;
    const auto command = static_cast<Command>(whole[1]);
    received.erase(received.begin(), received.begin() + static_cast<std::ptrdiff_t>(good ? *size : 1));
    if (good) return command;
  }
}

Bytes to_bytes(const Descriptor& descriptor) {
  Bytes bytes;
  append(bytes, kAnswerStart1);
  append(bytes, kAnswerStart2);
  append(bytes, descriptor.bytes | (descriptor.repeats ? 1U << kLengthBits : 0U));
  bytes.push_back(static_cast<std::uint8_t>(descriptor.type));
  return bytes;
}

std::optional<FoundDescriptor> find_descriptor(ByteView received, AnswerType type) {
  for (std::size_t i = 0; i + kDescriptorBytes <= received.size(); ++i) {
    if (received[i] != kAnswerStart1 || received[i + 1] != kAnswerStart2) continue;
    const Descriptor descriptor = descriptor_at(received.subspan(i));
    if (descriptor.type == type) return FoundDescriptor{descriptor, i + kDescriptorBytes};
  }
  return std::nullopt;
}

std::string Info::name() const {
  const int series = model >> 4, version = model & 0xF;
  constexpr int kFirstOfC = 4, kFirstOfS = 6;
  if (series >= kFirstOfS) return fmt::format("model 0x{:02X}", model);
  return series >= kFirstOfC ? fmt::format("C{}M{}", series - kFirstOfC + 1, version)
                             : fmt::format("A{}M{}", series, version);
}

Bytes to_bytes(const Info& info) {
  Bytes bytes;
  for (const std::uint8_t byte : {info.model, info.firmware_minor, info.firmware_major, info.hardware})
    append(bytes, byte);
  append(bytes, ByteView(info.serial));
  return bytes;
}

Bytes to_bytes(const Health& health) {
  Bytes bytes;
  append(bytes, static_cast<std::uint8_t>(health.status));
  append(bytes, health.code);
  return bytes;
}

Bytes to_bytes(const SampleTimes& times) {
  Bytes bytes;
  append(bytes, times.standard_us);
  append(bytes, times.express_us);
  return bytes;
}

Info info_in(ByteView answer) {
  Info info{answer[0], answer[1], answer[2], answer[3], {}};
  std::ranges::copy(answer.subspan(4, info.serial.size()), info.serial.begin());
  return info;
}

Health health_in(ByteView answer) {
  return {static_cast<HealthStatus>(answer[0]), load<std::uint16_t>(answer, 1)};
}

SampleTimes sample_times_in(ByteView answer) {
  return {load<std::uint16_t>(answer, 0), load<std::uint16_t>(answer, 2)};
}

}  // namespace astro::truth::rplidar
