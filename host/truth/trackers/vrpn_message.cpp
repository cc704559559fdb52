#include "host/truth/trackers/vrpn_message.hpp"

#include <algorithm>

#include "host/truth/trackers/big_endian.hpp"

namespace astro::truth::vrpn {
namespace {

constexpr std::string_view kVersion = "vrpn: ver. 07.";
constexpr std::string_view kCookie = "vrpn: ver. 07.35  0";  // 0: nothing is logged
constexpr std::size_t kAlignment = 8;
constexpr std::uint32_t kLongestName = 1000;  // ten times what the upstream library takes

}  // namespace

Bytes cookie() {
  Bytes bytes(kCookieBytes);
  std::copy(kCookie.begin(), kCookie.end(), bytes.begin());
  return bytes;
}

bool is_cookie(ByteView bytes) { return as_text(bytes).starts_with(kVersion); }

std::size_t padded(std::size_t length) { return (length + kAlignment - 1) / kAlignment * kAlignment; }

std::string fault_of_length(std::uint32_t length) {
  if (length >= kHeaderBytes && length <= kLongestMessage) return "";
  return "a message of " + std::to_string(length) + " bytes, and messages have " +
         std::to_string(kHeaderBytes) + " to " + std::to_string(kLongestMessage);
}

std::uint32_t length_in(ByteView header) { return load_big<std::uint32_t>(header, 0); }

Message message_in(ByteView bytes) {
  constexpr std::int64_t kMicro = 1'000'000;
  Message message;
  message.time_us = kMicro * load_big<std::uint32_t>(bytes, 4) + load_big<std::uint32_t>(bytes, 8);
  message.sender = load_big<std::int32_t>(bytes, 12);
  message.type = load_big<std::int32_t>(bytes, 16);
  message.sequence = load_big<std::uint32_t>(bytes, 20);
  message.payload = bytes.subspan(kHeaderBytes, length_in(bytes) - kHeaderBytes);
  return message;
}

void append(Bytes& out, const Message& message) {
  constexpr std::int64_t kMicro = 1'000'000;
  const std::size_t length = kHeaderBytes + message.payload.size(), end = out.size() + padded(length);
  append_big(out, static_cast<std::uint32_t>(length));
  append_big(out, static_cast<std::uint32_t>(message.time_us / kMicro));
  append_big(out, static_cast<std::uint32_t>(message.time_us % kMicro));
  append_big(out, message.sender);
  append_big(out, message.type);
  append_big(out, message.sequence);
  astro::append(out, message.payload);
  out.resize(end);
}

std::optional<std::string> name_in(ByteView payload) {
  if (payload.size() < sizeof(std::uint32_t)) return std::nullopt;
  const auto size = load_big<std::uint32_t>(payload, 0);
  if (size > kLongestName || size > payload.size() - sizeof(std::uint32_t)) return std::nullopt;
  const std::string_view text = as_text(payload.subspan(sizeof(std::uint32_t), size));
  return std::string(text.substr(0, text.find('\0')));
}

void append_description(Bytes& out, std::int32_t kind, std::int32_t id, std::string_view name,
                        std::int64_t time_us) {
  Bytes payload;
  append_big(payload, static_cast<std::uint32_t>(name.size() + 1));
  astro::append(payload, as_bytes(name));
  payload.push_back(0);
  append(out, {time_us, id, kind, 0, payload});
}

}  // namespace astro::truth::vrpn
