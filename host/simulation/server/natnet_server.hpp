#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <string>

#include "host/base/network.hpp"
#include "host/simulation/server/virtual_tracker.hpp"
#include "host/truth/trackers/natnet_packet.hpp"

namespace astro::simulation {

/// A NatNet server with one rigid body. It sends frames to each client for as long as the client keeps
/// asking, to the socket from which the client asked.
///
/// Bounds  16 clients. A client that has sent nothing for five seconds is dropped.
class NatNetServer {
 public:
  /// `at`: its address for commands. `data_port`: where clients are told to expect frames, too. Throws
  /// astro::Error if the address is in use.
  NatNetServer(const net::udp::endpoint& at, std::string body, truth::natnet::Version version,
               std::uint16_t data_port);

  /// Takes what clients send. `now_us`: on the tracker's clock.
  void work(std::int64_t now_us);
  /// `now_us`: when the frame leaves.
  void send(const TrackedFrame& frame, std::int64_t now_us);

  net::udp::endpoint endpoint() const { return socket_.local_endpoint(); }
  std::size_t clients() const { return clients_.size(); }

 private:
  struct Client {
    net::udp::endpoint endpoint;
    std::int64_t heard_us = 0;
  };

  void take(const net::Datagram& datagram, std::int64_t now_us);
  bool note_client(const net::udp::endpoint& from, bool connects, std::int64_t now_us);

  net::io_context io_;  // outlives the socket
  net::udp::socket socket_;
  std::string body_;
  truth::natnet::Version version_;
  std::uint16_t data_port_;
  std::list<Client> clients_;
};

}  // namespace astro::simulation
