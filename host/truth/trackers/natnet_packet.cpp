#include "host/truth/trackers/natnet_packet.hpp"

#include <algorithm>

namespace astro::truth::natnet {
namespace {

constexpr std::size_t kNameBytes = 256;

void append_padded(Bytes& bytes, std::string_view text, std::size_t size) {
  const std::size_t end = bytes.size() + size;
  append(bytes, as_bytes(text.substr(0, size - 1)));
  bytes.resize(end);
}

}  // namespace

std::optional<Packet> packet_in(ByteView datagram) {
  ByteCursor cursor(datagram);
  Packet packet;
  packet.id = static_cast<Id>(cursor.number<std::uint16_t>());
  packet.payload = cursor.take(cursor.number<std::uint16_t>());
  return cursor.ok() ? std::optional(packet) : std::nullopt;
}

Bytes datagram_of(Id id, ByteView payload) {
  Bytes bytes;
  append(bytes, static_cast<std::uint16_t>(id));
  append(bytes, static_cast<std::uint16_t>(payload.size()));
  append(bytes, payload);
  return bytes;
}

/// The request of a client of version 3.0, to which the server sends its own version. Only unicast servers
/// would fulfil a request for another version.
Bytes connect_request() {
  Bytes payload;
  append_padded(payload, "NatNet client", kNameBytes);
  append(payload, Bytes{1, 0, 0, 0});
  append(payload, Bytes{3, 0, 0, 0});
  return datagram_of(Id::connect, payload);
}

std::optional<ServerInfo> server_info_in(ByteView payload) {
  ByteCursor cursor(payload);
  ServerInfo info;
  const std::string_view name = as_text(cursor.take(kNameBytes));
  info.application = name.substr(0, name.find('\0'));
  cursor.take(4);  // the application's version
  info.version = {cursor.number<std::uint8_t>(), cursor.number<std::uint8_t>()};
  cursor.take(2);
  if (!cursor.ok() || info.version < Version{3, 0}) return cursor.ok() ? std::optional(info) : std::nullopt;
  info.ticks_per_s = cursor.number<std::uint64_t>();
  info.data_port = cursor.number<std::uint16_t>();
  info.multicast = cursor.number<std::uint8_t>() != 0;
  const ByteView group = cursor.take(info.group.size());
  std::copy(group.begin(), group.end(), info.group.begin());
  return cursor.ok() ? std::optional(info) : std::nullopt;
}

Bytes payload_of(const ServerInfo& info) {
  Bytes bytes;
  append_padded(bytes, info.application, kNameBytes);
  append(bytes, Bytes{1, 0, 0, 0, info.version.major, info.version.minor, 0, 0});
  append(bytes, info.ticks_per_s);
  append(bytes, info.data_port);
  append(bytes, static_cast<std::uint8_t>(info.multicast ? 1 : 0));
  append(bytes, info.group);
  return bytes;
}

std::string_view take_text(ByteCursor& cursor) {
  ByteCursor ahead = cursor;
  std::size_t size = 0;
  while (ahead.ok() && ahead.number<std::uint8_t>() != 0) ++size;
  const std::string_view text = as_text(cursor.take(size));
  cursor.take(1);
  return text;
}

void append_text(Bytes& bytes, std::string_view text) {
  append(bytes, as_bytes(text));
  bytes.push_back(0);
}

}  // namespace astro::truth::natnet
