#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <string>

#include "host/base/network.hpp"
#include "host/simulation/server/virtual_tracker.hpp"
#include "host/truth/trackers/vrpn_directory.hpp"
#include "host/truth/trackers/vrpn_reader.hpp"

namespace astro::simulation {

/// A VRPN server with one tracked body, for our own client and for those of others. It serves each client
/// that connects by TCP, connects back to each one that asks by UDP, and answers pings. Poses go by TCP in
/// either case.
///
/// Bounds  16 clients. A client is disconnected if more than 64 KiB wait for it, and at once if it sends
///         anything that is not VRPN.
class VrpnServer {
 public:
  /// `at`: its address for TCP and UDP. Throws astro::Error if that is in use.
  VrpnServer(const net::tcp::endpoint& at, std::string body);

  /// Takes new clients and what they send. `now_us`: on the tracker's clock.
  void work(std::int64_t now_us);
  void send(const TrackedFrame& frame);

  net::tcp::endpoint endpoint() const { return listener_.local_endpoint(); }
  std::size_t clients() const { return clients_.size(); }

 private:
  struct Client {
    net::tcp::socket socket;
    std::shared_ptr<const net::Connecting> called;  // until it answers, if we connect back to it
    bool closed = false;
    Bytes waiting{};
    truth::vrpn::StreamReader reader{};
    truth::vrpn::Directory directory{};
  };

  net::udp::socket bind_requests(const net::tcp::endpoint& at);
  void add(net::tcp::socket socket, std::shared_ptr<const net::Connecting> called, std::int64_t now_us);
  void accept(std::int64_t now_us);
  void take_requests(std::int64_t now_us);
  static void follow_call(Client& client);
  void read(Client& client, std::int64_t now_us);
  void answer(Client& client, const truth::vrpn::Message& message, std::int64_t now_us);
  static void write(Client& client);

  net::io_context io_;  // outlives the sockets
  net::tcp::acceptor listener_;
  net::udp::socket requests_;
  std::string body_;
  std::list<Client> clients_;
  std::uint32_t sequence_ = 0;
};

}  // namespace astro::simulation
