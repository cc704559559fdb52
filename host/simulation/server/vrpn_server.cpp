#include "host/simulation/server/vrpn_server.hpp"

#include <array>
#include <charconv>
#include <string_view>
#include <utility>

#include "host/base/error.hpp"
#include "host/truth/trackers/vrpn_tracker.hpp"

namespace astro::simulation {

namespace vrpn = truth::vrpn;

namespace {

constexpr std::size_t kMostClients = 16;
constexpr int kMostWaiting = 1 << 16;
constexpr std::uint16_t kFirstUserPort = 1024;

// Our own ids. Clients learn them from the descriptions.
constexpr std::int32_t kControl = 0, kBody = 1;
constexpr std::int32_t kPose = 0, kPing = 1, kPong = 2;
constexpr std::string_view kPingName = "vrpn_Base ping_message", kPongName = "vrpn_Base pong_message";

/// The port in "HOST PORT", which ends with a NUL; 0 if there is none to which the server may connect.
std::uint16_t port_in(std::string_view request) {
  const std::size_t space = request.find(' ');
  if (space == std::string_view::npos) return 0;
  std::uint16_t port = 0;
  std::from_chars(request.data() + space + 1, request.data() + request.size(), port);
  return port < kFirstUserPort ? std::uint16_t{0} : port;
}

/// The first bytes that each client gets.
Bytes greeting(const std::string& body, std::int64_t now_us) {
  Bytes bytes = vrpn::cookie();
  vrpn::append_description(bytes, vrpn::kSenderDescription, kControl, "VRPN Control", now_us);
  vrpn::append_description(bytes, vrpn::kSenderDescription, kBody, body, now_us);
  vrpn::append_description(bytes, vrpn::kTypeDescription, kPose, vrpn::kPoseType, now_us);
  vrpn::append_description(bytes, vrpn::kTypeDescription, kPing, kPingName, now_us);
  vrpn::append_description(bytes, vrpn::kTypeDescription, kPong, kPongName, now_us);
  return bytes;
}

}  // namespace

VrpnServer::VrpnServer(const net::tcp::endpoint& at, std::string body)
    : listener_(net::listen_tcp(io_, at)), requests_(bind_requests(at)), body_(std::move(body)) {}

/// Of the port numbers that the system finds free for TCP, some are in use for UDP. If any will do, others are
/// tried.
net::udp::socket VrpnServer::bind_requests(const net::tcp::endpoint& at) {
  constexpr int kMostTries = 20;
  for (int i = 1;; ++i) {
    try {
      return net::bind_udp(io_, {at.address(), endpoint().port()});
    } catch (const Error&) {
      if (at.port() != 0 || i == kMostTries) throw;
      listener_ = net::listen_tcp(io_, at);
    }
  }
}

void VrpnServer::work(std::int64_t now_us) {
  io_.restart();
  io_.poll();  // what has become of the connections to clients that asked
  accept(now_us);
  take_requests(now_us);
  for (Client& client : clients_) {
    if (client.called) follow_call(client);
    if (client.called || client.closed) continue;
    read(client, now_us);
    write(client);
  }
  std::erase_if(clients_, [](const Client& client) { return client.closed; });
}

void VrpnServer::add(net::tcp::socket socket, std::shared_ptr<const net::Connecting> called,
                     std::int64_t now_us) {
  if (clients_.size() >= kMostClients) return;
  // Without this bound the system keeps megabytes that a client has not taken.
  socket.set_option(net::tcp::socket::send_buffer_size(kMostWaiting));
  clients_.push_back({std::move(socket), std::move(called), false, greeting(body_, now_us)});
}

void VrpnServer::accept(std::int64_t now_us) {
  while (auto accepted = net::accept_tcp(listener_)) add(std::move(accepted->socket), nullptr, now_us);
}

void VrpnServer::take_requests(std::int64_t now_us) {
  std::array<std::uint8_t, 256> buffer;  // NOLINT(cppcoreguidelines-pro-type-member-init): receive fills it
  while (const auto request = net::receive_datagram(requests_, buffer)) {
    const std::uint16_t port = port_in(as_text(request->bytes));
    if (port == 0) continue;
    if (auto attempt = net::begin_tcp(io_, {request->from.address(), port}))
      add(std::move(attempt->socket), std::move(attempt->state), now_us);
  }
}

void VrpnServer::follow_call(Client& client) {
  client.closed = *client.called == net::Connecting::failed;
  if (*client.called == net::Connecting::connected) client.called.reset();
}

void VrpnServer::read(Client& client, std::int64_t now_us) {
  std::array<std::uint8_t, 4096> buffer;  // NOLINT(cppcoreguidelines-pro-type-member-init): receive fills it
  try {
    const auto bytes = net::receive(client.socket, buffer);
    client.closed = !bytes;
    if (!bytes) return;
    client.reader.push(*bytes);
    while (const auto message = client.reader.next()) answer(client, *message, now_us);
  } catch (const Error&) {
    client.closed = true;  // it does not speak VRPN
  }
}

void VrpnServer::answer(Client& client, const vrpn::Message& message, std::int64_t now_us) {
  if (client.directory.take(message)) return;
  const bool asks_us = client.directory.sender(message.sender) == body_;
  if (asks_us && client.directory.type(message.type) == kPingName)
    vrpn::append(client.waiting, {now_us, kBody, kPong, ++sequence_, {}});
}

void VrpnServer::write(Client& client) {
  const auto taken = net::send(client.socket, client.waiting);
  client.closed = client.closed || !taken || client.waiting.size() > std::size_t{kMostWaiting};
  if (taken)
    client.waiting.erase(client.waiting.begin(),
                         client.waiting.begin() + static_cast<std::ptrdiff_t>(*taken));
}

void VrpnServer::send(const TrackedFrame& frame) {
  const Bytes payload = vrpn::payload_of({0, frame.pose});
  for (Client& client : clients_)
    if (!client.called) vrpn::append(client.waiting, {frame.exposed_us, kBody, kPose, ++sequence_, payload});
}

}  // namespace astro::simulation
