#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "host/base/bytes.hpp"

/// NatNet, the protocol of OptiTrack's Motive, versions 3.0 to 4.x: datagrams, little-endian and packed.
///
/// Source  the layout of 3.0 was checked byte by byte against a recording of Motive 2.1; the differences of
///         4.1 are those of three public clients.
namespace astro::truth::natnet {

inline constexpr std::uint16_t kCommandPort = 1510;
inline constexpr std::uint16_t kDataPort = 1511;

enum class Id : std::uint16_t {
  connect = 0,
  server_info = 1,
  request = 2,
  response = 3,
  request_models = 4,
  models = 5,
  frame = 7,
  keep_alive = 10,
  echo_request = 12,
  echo_response = 13,
};

struct Version {
  std::uint8_t major = 3, minor = 0;
  auto operator<=>(const Version&) const = default;
};

/// One datagram: what it is, and its content.
struct Packet {
  Id id{};
  ByteView payload;
};

/// Nothing if the datagram is shorter than its header says.
std::optional<Packet> packet_in(ByteView datagram);
Bytes datagram_of(Id id, ByteView payload = {});

/// The first request of a client. The server answers with ServerInfo.
Bytes connect_request();

struct ServerInfo {
  std::string application;        // "Motive"
  Version version;                // of the frames it sends
  std::uint64_t ticks_per_s = 0;  // of its clock
  std::uint16_t data_port = kDataPort;
  bool multicast = false;
  std::array<std::uint8_t, 4> group{};  // to which it multicasts

  bool operator==(const ServerInfo&) const = default;
};

std::optional<ServerInfo> server_info_in(ByteView payload);
Bytes payload_of(const ServerInfo& info);

/// Takes a text that ends with a NUL off a cursor. Makes it !ok() if there is no NUL.
std::string_view take_text(ByteCursor& cursor);
void append_text(Bytes& bytes, std::string_view text);

}  // namespace astro::truth::natnet
