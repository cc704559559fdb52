#include "host/base/network.hpp"

#include <fcntl.h>
#include <netinet/tcp.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/ip/multicast.hpp>
#include <boost/system/system_error.hpp>
#include <cerrno>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/system_error.hpp"

namespace astro::net {

namespace asio = boost::asio;
using boost::system::error_code;

namespace {

template <class Socket>
void configure(Socket& socket) {
  socket.non_blocking(true);
  ::fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
}

/// Without a free descriptor it does not help to try again, or to try another address. The first socket of an
/// io_context opens descriptors for that, too.
template <class Socket>
Socket open_socket(io_context& io, const typename Socket::protocol_type& protocol) {
  try {
    Socket socket(io, protocol);
    configure(socket);
    return socket;
  } catch (const boost::system::system_error& error) {
    const int code = error.code().value();
    if (code == EMFILE || code == ENFILE) throw system_error("no socket can be opened", code);
    throw;
  }
}

udp::socket open_udp(io_context& io, const udp& protocol) {
  auto socket = open_socket<udp::socket>(io, protocol);
  constexpr int kKeptBytes = 1 << 20;  // of datagrams that come while nobody reads
  error_code ignored;
  socket.set_option(udp::socket::receive_buffer_size(kKeptBytes), ignored);
  return socket;
}

/// Poses are small and must not wait for one another. A peer whose computer was switched off sends nothing,
/// so keep-alive ends its connection after some ten seconds.
void set_up_connection(tcp::socket& socket) {
  using asio::detail::socket_option::integer;
  error_code ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  socket.set_option(tcp::socket::keep_alive(true), ignored);
  socket.set_option(integer<IPPROTO_TCP, TCP_KEEPIDLE>(4), ignored);
  socket.set_option(integer<IPPROTO_TCP, TCP_KEEPINTVL>(2), ignored);
  socket.set_option(integer<IPPROTO_TCP, TCP_KEEPCNT>(3), ignored);
}

template <class Endpoint>
Error port_unusable(const Endpoint& local, const error_code& error) {
  const std::string port = std::to_string(local.port()), host = local.address().to_string();
  return system_error("port " + port + " of " + host + " cannot be used", error.value(), {},
                      AddressProblem::port_unusable, {port, host});
}

bool comes_later(const error_code& error) {
  return error == asio::error::would_block || error == asio::error::interrupted;
}

}  // namespace

std::vector<address> addresses_of(const std::string& host) {
  io_context io;
  error_code error;
  std::vector<address> addresses;
  for (const auto& found : tcp::resolver(io).resolve(host, "", error))
    addresses.push_back(found.endpoint().address());
  if (error)
    throw Error("the host '" + host + "' was not found: " + error.message(), AddressProblem::host_unknown,
                {host});
  return addresses;
}

tcp::acceptor listen_tcp(io_context& io, const tcp::endpoint& local) {
  try {
    auto listener = open_socket<tcp::acceptor>(io, local.protocol());
    // Without this option even a non-blocking accept() waits for the next connection if one was aborted.
    listener.set_option(tcp::acceptor::enable_connection_aborted(true));
    listener.set_option(tcp::acceptor::reuse_address(true));  // a port of a program that has just ended
    listener.bind(local);
    listener.listen(8);
    return listener;
  } catch (const boost::system::system_error& error) {
    throw port_unusable(local, error.code());
  }
}

udp::socket bind_udp(io_context& io, const udp::endpoint& local) {
  try {
    udp::socket socket = open_udp(io, local.protocol());
    socket.bind(local);
    return socket;
  } catch (const boost::system::system_error& error) {
    throw port_unusable(local, error.code());
  }
}

udp::socket connect_udp(io_context& io, const udp::endpoint& to) {
  try {
    udp::socket socket = open_udp(io, to.protocol());
    socket.connect(to);
    return socket;
  } catch (const boost::system::system_error& error) {
    throw system_error(to.address().to_string() + " cannot be reached", error.code().value());
  }
}

/// The socket is bound to the group itself, so that it receives nothing else.
udp::socket join_multicast(io_context& io, const udp::endpoint& group, const address& local) {
  try {
    if (!local.is_v4() || !group.address().is_v4())
      throw boost::system::system_error(asio::error::address_family_not_supported);
    udp::socket socket = open_udp(io, group.protocol());
    socket.set_option(udp::socket::reuse_address(true));
    socket.bind(group);
    socket.set_option(asio::ip::multicast::join_group(group.address().to_v4(), local.to_v4()));
    return socket;
  } catch (const boost::system::system_error& error) {
    throw system_error(
        "the multicast group " + group.address().to_string() + " cannot be joined at " + local.to_string(),
        error.code().value());
  }
}

std::optional<Attempt> begin_tcp(io_context& io, const tcp::endpoint& to) {
  try {
    const auto state = std::make_shared<Connecting>(Connecting::pending);
    Attempt attempt{open_socket<tcp::socket>(io, to.protocol()), state};
    set_up_connection(attempt.socket);
    attempt.socket.async_connect(to, [state](const error_code& error) {
      *state = error ? Connecting::failed : Connecting::connected;
    });
    return attempt;
  } catch (const boost::system::system_error&) {
    return std::nullopt;
  }
}

std::optional<Accepted> accept_tcp(tcp::acceptor& listener) {
  error_code error;
  tcp::endpoint from;
  tcp::socket socket = listener.accept(from, error);
  if (error) return std::nullopt;
  configure(socket);
  set_up_connection(socket);
  return Accepted{std::move(socket), from};
}

std::optional<std::size_t> send(tcp::socket& socket, ByteView bytes) {
  error_code error;
  const std::size_t count = socket.send(asio::buffer(bytes.data(), bytes.size()), 0, error);
  return !error || comes_later(error) ? std::optional(count) : std::nullopt;
}

std::optional<ByteView> receive(tcp::socket& socket, std::span<std::uint8_t> buffer) {
  error_code error;
  const std::size_t count = socket.receive(asio::buffer(buffer.data(), buffer.size()), 0, error);
  return !error || comes_later(error) ? std::optional<ByteView>(buffer.first(count)) : std::nullopt;
}

void send_datagram(udp::socket& socket, ByteView bytes, const udp::endpoint& to) {
  error_code ignored;
  socket.send_to(asio::buffer(bytes.data(), bytes.size()), to, 0, ignored);
}

std::optional<Datagram> receive_datagram(udp::socket& socket, std::span<std::uint8_t> buffer) {
  error_code error;
  Datagram datagram;
  const std::size_t count =
      socket.receive_from(asio::buffer(buffer.data(), buffer.size()), datagram.from, 0, error);
  if (error) return std::nullopt;
  datagram.bytes = buffer.first(count);
  return datagram;
}

}  // namespace astro::net
