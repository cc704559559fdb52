#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "host/base/bytes.hpp"

/// What VRPN (Virtual-Reality Peripheral Network, version 07) puts on the wire.
///
/// Source  the upstream library (vrpn/vrpn, 07.38), checked byte by byte against its server.
namespace astro::truth::vrpn {

/// One message. Ids of senders and types are the sending side's own: it describes them before it uses them.
/// Negative types are messages of the connection itself.
struct Message {
  std::int64_t time_us = 0;  // on the sender's clock, whose zero may be anything
  std::int32_t sender = 0, type = 0;
  std::uint32_t sequence = 0;
  ByteView payload;
};

inline constexpr std::int32_t kSenderDescription = -1;  // `sender` is the id that gets the name
inline constexpr std::int32_t kTypeDescription = -2;    // the same for the id of a type
inline constexpr std::int32_t kUdpDescription = -3;     // `sender` is the port that takes messages by UDP

inline constexpr std::size_t kHeaderBytes = 24;
inline constexpr std::size_t kLongestMessage = 64'000;  // header included; a pose has 88
inline constexpr std::uint16_t kPort = 3883;            // TCP and UDP, if nobody chose another

/// The first 24 bytes of each side of a TCP connection, and of a UDP datagram without messages.
inline constexpr std::size_t kCookieBytes = 24;
Bytes cookie();
/// Whether the other side speaks this version: the digits after its last point may differ.
bool is_cookie(ByteView bytes);

/// The bytes that a message of this length takes on the wire: the payload is padded to a multiple of eight,
/// and the length in the header does not count the padding.
std::size_t padded(std::size_t length);

/// Why the number in a header cannot be the length of a message: a clause; "" if it can.
std::string fault_of_length(std::uint32_t length);

/// Precondition: at least kHeaderBytes.
std::uint32_t length_in(ByteView header);
/// Precondition: at least as many bytes as length_in() says.
Message message_in(ByteView bytes);

/// Precondition: the payload fits into kLongestMessage.
void append(Bytes& out, const Message& message);

/// A name in a description; nothing if the payload is none. The name is cut at its first NUL.
std::optional<std::string> name_in(ByteView payload);
/// `kind`: kSenderDescription or kTypeDescription.
void append_description(Bytes& out, std::int32_t kind, std::int32_t id, std::string_view name,
                        std::int64_t time_us);

}  // namespace astro::truth::vrpn
