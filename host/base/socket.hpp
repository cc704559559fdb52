#pragma once

#include <sys/socket.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/base/descriptor.hpp"

/// TCP and UDP without waiting: all sockets are non-blocking, and only the functions with a time-out wait.
namespace astro::net {

using std::chrono::microseconds;

/// What is wrong with an address. Values: the host's name; the port and this computer's address.
enum class AddressProblem { host_unknown, port_unusable };

using Socket = Descriptor;

/// Whether it is an address in digits, of either family: "192.168.1.7", "::1".
bool is_address(const std::string& text);

/// An address on the network, of either family.
struct Address {
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;

  /// All addresses of a host, at least one, in the order in which they should be tried. Throws astro::Error if its name
  /// has none.
  static std::vector<Address> all_of(const std::string& host, std::uint16_t port);
  /// The address that only this computer itself reaches, and the one that stands for all of its networks.
  static Address loopback(std::uint16_t port);
  static Address everywhere(std::uint16_t port);
  /// This computer's end of a socket.
  static Address local(const Socket& socket);

  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  std::string host() const;  // in digits
  std::uint16_t port() const;
  Address with_port(std::uint16_t port) const;
};

/// True if there is something to read, or the other side has gone.
bool wait_to_read(const Socket& socket, microseconds timeout);
/// The same for either of two sockets; the second may be empty.
bool wait_to_read(const Socket& one, const Socket& other, microseconds timeout);

/// True if a connection that was begun has succeeded or failed.
bool wait_to_connect(const Socket& socket, microseconds timeout);

/// Begins to connect; connecting() tells when that is done. Empty if it failed at once.
Socket begin_tcp(const Address& to);
enum class Connecting : std::uint8_t { pending, connected, failed };
/// Reports a failure only once.
Connecting connecting(const Socket& socket);

/// Port 0: any that is free. Throw astro::Error if the port is in use or the address is not this computer's.
Socket listen_tcp(const Address& local);
Socket bind_udp(const Address& local);

/// Receives what is sent to an IPv4 group, on the network of a local address. Other programs on this computer
/// may listen to the same group. Throws astro::Error.
Socket join_multicast(const std::array<std::uint8_t, 4>& group, std::uint16_t port, const Address& local);

/// A connection that waits, and where it comes from; empty if none does.
struct Accepted {
  Socket socket;
  Address from;
};
std::optional<Accepted> accept_tcp(const Socket& listener);

/// A socket whose datagrams come from and go to this address alone. Throws astro::Error.
Socket connect_udp(const Address& to);

/// The number of bytes that were taken, maybe 0; nothing if the connection has ended.
std::optional<std::size_t> send(const Socket& socket, ByteView bytes);
/// One datagram, which is lost if it cannot be sent now.
void send_datagram(const Socket& socket, ByteView bytes, const Address& to);

/// Limits the bytes that the system keeps because the other side has not taken them yet to about this many;
/// without a limit it keeps megabytes.
void bound_sending(const Socket& socket, int bytes);

/// The bytes that have arrived on a connection, in `buffer`; empty if there are none, and nullopt if the
/// connection has ended.
std::optional<ByteView> receive(const Socket& socket, std::span<std::uint8_t> buffer);
/// The next datagram, in `buffer` and cut to its size, and where it comes from; nothing if none waits.
struct Datagram {
  ByteView bytes;
  Address from;
};
std::optional<Datagram> receive_datagram(const Socket& socket, std::span<std::uint8_t> buffer);

}  // namespace astro::net
