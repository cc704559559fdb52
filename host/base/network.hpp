#pragma once

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/udp.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/bytes.hpp"

/// TCP and UDP on Boost.Asio without waiting: all sockets that these functions make are non-blocking, and
/// only wait_to_read() waits. No child process inherits them. A function that needs a socket throws
/// astro::Error if this program can open no more.
namespace astro::net {

using boost::asio::io_context;
using boost::asio::ip::address;
using boost::asio::ip::address_v4;
using boost::asio::ip::tcp;
using boost::asio::ip::udp;

/// What is wrong with an address. Values: the host's name; the port and this computer's address.
enum class AddressProblem { host_unknown, port_unusable };

/// All addresses of a host, at least one, in the order in which they should be tried. Throws astro::Error if
/// its name has none.
std::vector<address> addresses_of(const std::string& host);

/// Port 0: any that is free. Throw astro::Error if the port is in use or the address is not this computer's.
tcp::acceptor listen_tcp(io_context& io, const tcp::endpoint& local);
udp::socket bind_udp(io_context& io, const udp::endpoint& local);

/// A socket whose datagrams come from and go to this address alone. Throws astro::Error.
udp::socket connect_udp(io_context& io, const udp::endpoint& to);

/// Receives what is sent to an IPv4 group, on the network of a local address. Other programs on this computer
/// may listen to the same group. Throws astro::Error.
udp::socket join_multicast(io_context& io, const udp::endpoint& group, const address& local);

/// A connection that is being made. io_context::poll() updates the state; if the socket is closed, to failed.
enum class Connecting : std::uint8_t { pending, connected, failed };
struct Attempt {
  tcp::socket socket;
  std::shared_ptr<const Connecting> state;
};
/// Empty if this computer has no such sockets.
std::optional<Attempt> begin_tcp(io_context& io, const tcp::endpoint& to);

/// A connection that waits, and where it comes from; empty if none does.
struct Accepted {
  tcp::socket socket;
  tcp::endpoint from;
};
std::optional<Accepted> accept_tcp(tcp::acceptor& listener);

/// The number of bytes that were taken, maybe 0; nothing if the connection has ended.
std::optional<std::size_t> send(tcp::socket& socket, ByteView bytes);
/// The bytes that have arrived on a connection, in `buffer`; empty if there are none, and nullopt if the
/// connection has ended.
std::optional<ByteView> receive(tcp::socket& socket, std::span<std::uint8_t> buffer);

/// One datagram, which is lost if it cannot be sent now.
void send_datagram(udp::socket& socket, ByteView bytes, const udp::endpoint& to);
/// The next datagram, in `buffer` and cut to its size, and where it comes from; nothing if none waits.
struct Datagram {
  ByteView bytes;
  udp::endpoint from;
};
std::optional<Datagram> receive_datagram(udp::socket& socket, std::span<std::uint8_t> buffer);

/// True if one of the sockets has something to read, or its other side has gone. Also returns, with false,
/// when an attempt to connect has ended, and at the latest after `timeout`.
template <class... Sockets>
bool wait_to_read(io_context& io, std::chrono::microseconds timeout, Sockets&... sockets) {
  const auto waits_without_sockets = boost::asio::make_work_guard(io);
  bool ready = false;
  [[maybe_unused]] const auto note = [&](const boost::system::error_code& error) { ready = ready || !error; };
  (sockets.async_wait(Sockets::wait_read, note), ...);
  io.restart();
  io.run_one_for(timeout);
  (sockets.cancel(), ...);
  io.poll();  // the handlers, which refer to `ready`
  return ready;
}

}  // namespace astro::net
