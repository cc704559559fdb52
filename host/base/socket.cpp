#include "host/base/socket.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include "host/base/error.hpp"
#include "host/base/system_error.hpp"

namespace astro::net {
namespace {

timespec limit_of(microseconds timeout) {
  constexpr std::int64_t kMicro = 1'000'000;
  return {timeout.count() / kMicro, timeout.count() % kMicro * 1000};
}

bool poll_for(const Socket& socket, short events, microseconds timeout) {
  pollfd ready{socket.get(), events, 0};
  const timespec limit = limit_of(timeout);
  return ::ppoll(&ready, 1, &limit, nullptr) > 0;
}

Socket open_socket(int family, int type) {
  Socket socket(::socket(family, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  // Without a free descriptor it does not help to try again, or to try another address.
  if (!socket && (errno == EMFILE || errno == ENFILE)) throw system_error("no socket can be opened", errno);
  const int kept_bytes = 1 << 20;  // of datagrams that come while nobody reads
  if (type == SOCK_DGRAM) ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVBUF, &kept_bytes, sizeof kept_bytes);
  return socket;
}

/// Poses are small and must not wait for one another. A peer whose computer was switched off sends nothing,
/// so keep-alive ends its connection after some ten seconds.
void set_up(const Socket& socket) {
  const auto set = [&](int level, int option, int value) {
    ::setsockopt(socket.get(), level, option, &value, sizeof value);
  };
  set(IPPROTO_TCP, TCP_NODELAY, 1);
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, 4);
  set(IPPROTO_TCP, TCP_KEEPINTVL, 2);
  set(IPPROTO_TCP, TCP_KEEPCNT, 3);
}

std::string numeric(const Address& address, int flag) {
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> service{};
  ::getnameinfo(address.get(), address.size, host.data(), host.size(), service.data(), service.size(),
                NI_NUMERICHOST | NI_NUMERICSERV);
  return flag == NI_NUMERICHOST ? host.data() : service.data();
}

[[noreturn]] void fail_bound(const Address& local) {
  const int code = errno;
  const std::string port = std::to_string(local.port()), host = local.host();
  throw system_error("port " + port + " of " + host + " cannot be used", code, {},
                     AddressProblem::port_unusable, {port, host});
}

Socket open_bound(const Address& local, int type) {
  Socket socket = open_socket(local.storage.ss_family, type);
  const int reuse = 1;  // a port of a program that has just ended
  if (socket && type == SOCK_STREAM)
    ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &reuse, sizeof reuse);
  if (!socket || ::bind(socket.get(), local.get(), local.size) != 0) fail_bound(local);
  return socket;
}

Address ip4(in_addr_t host, std::uint16_t port) {
  Address address;
  auto* in = reinterpret_cast<sockaddr_in*>(&address.storage);
  in->sin_family = AF_INET;
  in->sin_addr.s_addr = htonl(host);
  in->sin_port = htons(port);
  address.size = sizeof *in;
  return address;
}

}  // namespace

bool is_address(const std::string& text) {
  in6_addr bytes{};  // room for either
  return ::inet_pton(AF_INET, text.c_str(), &bytes) == 1 || ::inet_pton(AF_INET6, text.c_str(), &bytes) == 1;
}

std::vector<Address> Address::all_of(const std::string& host, std::uint16_t port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int failed = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(found, ::freeaddrinfo);
  if (failed != 0)
    throw Error("the host '" + host + "' was not found: " + ::gai_strerror(failed),
                AddressProblem::host_unknown, {host});
  std::vector<Address> addresses;
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    Address& address = addresses.emplace_back();
    address.size = one->ai_addrlen;
    std::memcpy(&address.storage, one->ai_addr, one->ai_addrlen);
  }
  return addresses;
}

Address Address::loopback(std::uint16_t port) { return ip4(INADDR_LOOPBACK, port); }
Address Address::everywhere(std::uint16_t port) { return ip4(INADDR_ANY, port); }

Address Address::local(const Socket& socket) {
  Address address;
  ::getsockname(socket.get(), address.get(), &address.size);
  return address;
}

std::string Address::host() const { return numeric(*this, NI_NUMERICHOST); }

std::uint16_t Address::port() const {
  return ntohs(storage.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6*>(&storage)->sin6_port
                                             : reinterpret_cast<const sockaddr_in*>(&storage)->sin_port);
}

Address Address::with_port(std::uint16_t port) const {
  Address address = *this;
  (storage.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6*>(&address.storage)->sin6_port
                                 : reinterpret_cast<sockaddr_in*>(&address.storage)->sin_port) = htons(port);
  return address;
}

bool wait_to_read(const Socket& socket, microseconds timeout) { return poll_for(socket, POLLIN, timeout); }

Socket begin_tcp(const Address& to) {
  Socket socket = open_socket(to.storage.ss_family, SOCK_STREAM);
  if (!socket) return {};
  set_up(socket);
  if (::connect(socket.get(), to.get(), to.size) != 0 && errno != EINPROGRESS) return {};
  return socket;
}

bool wait_to_read(const Socket& one, const Socket& other, microseconds timeout) {
  std::array<pollfd, 2> ready{pollfd{one.get(), POLLIN, 0}, pollfd{other.get(), POLLIN, 0}};
  const timespec limit = limit_of(timeout);
  return ::ppoll(ready.data(), ready.size(), &limit, nullptr) > 0;
}

bool wait_to_connect(const Socket& socket, microseconds timeout) {
  return poll_for(socket, POLLOUT, timeout);
}

Connecting connecting(const Socket& socket) {
  if (!wait_to_connect(socket, microseconds::zero())) return Connecting::pending;
  int failed = 0;
  socklen_t size = sizeof failed;
  ::getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &failed, &size);
  return failed == 0 ? Connecting::connected : Connecting::failed;
}

Socket listen_tcp(const Address& local) {
  Socket socket = open_bound(local, SOCK_STREAM);
  if (::listen(socket.get(), 8) != 0) fail_bound(local);
  return socket;
}

Socket bind_udp(const Address& local) { return open_bound(local, SOCK_DGRAM); }

/// The socket is bound to the group itself, so that it receives nothing else.
Socket join_multicast(const std::array<std::uint8_t, 4>& group, std::uint16_t port, const Address& local) {
  in_addr_t host = 0;
  for (const std::uint8_t byte : group) host = host << 8U | byte;
  Socket socket = open_socket(AF_INET, SOCK_DGRAM);
  const int shared = 1;
  ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &shared, sizeof shared);
  const Address at = ip4(host, port);
  ip_mreq membership{};
  membership.imr_multiaddr.s_addr = htonl(host);
  membership.imr_interface = reinterpret_cast<const sockaddr_in*>(&local.storage)->sin_addr;
  if (!socket || local.storage.ss_family != AF_INET || ::bind(socket.get(), at.get(), at.size) != 0 ||
      ::setsockopt(socket.get(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) != 0)
    throw system_error("the multicast group " + at.host() + " cannot be joined at " + local.host(), errno);
  return socket;
}

std::optional<Accepted> accept_tcp(const Socket& listener) {
  Accepted accepted;
  accepted.socket = Socket(
      ::accept4(listener.get(), accepted.from.get(), &accepted.from.size, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!accepted.socket) return std::nullopt;
  set_up(accepted.socket);
  return accepted;
}

Socket connect_udp(const Address& to) {
  Socket socket = open_socket(to.storage.ss_family, SOCK_DGRAM);
  if (!socket || ::connect(socket.get(), to.get(), to.size) != 0)
    throw system_error(to.host() + " cannot be reached", errno);
  return socket;
}

std::optional<std::size_t> send(const Socket& socket, ByteView bytes) {
  const ssize_t count = ::send(socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno == EAGAIN || errno == EINTR) return 0;
  return std::nullopt;
}

void send_datagram(const Socket& socket, ByteView bytes, const Address& to) {
  ::sendto(socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL, to.get(), to.size);
}

void bound_sending(const Socket& socket, int bytes) {
  ::setsockopt(socket.get(), SOL_SOCKET, SO_SNDBUF, &bytes, sizeof bytes);
}

std::optional<ByteView> receive(const Socket& socket, std::span<std::uint8_t> buffer) {
  const ssize_t count = ::recv(socket.get(), buffer.data(), buffer.size(), 0);
  if (count > 0) return ByteView(buffer.first(static_cast<std::size_t>(count)));
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return ByteView();
  return std::nullopt;
}

std::optional<Datagram> receive_datagram(const Socket& socket, std::span<std::uint8_t> buffer) {
  Datagram datagram;
  const ssize_t count =
      ::recvfrom(socket.get(), buffer.data(), buffer.size(), 0, datagram.from.get(), &datagram.from.size);
  if (count < 0) return std::nullopt;
  datagram.bytes = buffer.first(static_cast<std::size_t>(count));
  return datagram;
}

}  // namespace astro::net
