#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/live/foxglove/hub.hpp"

namespace astro::foxglove {

/// What connections have in common. It must outlive them, because a connection still calls `hub` and `notice` in its
/// destructor.
struct ConnectionRules {
  std::vector<std::string> origins;  // allowed in addition to the usual ones (origin.hpp)
  std::set<std::string> refused;     // already reported, because a page may try again and again
  Hub* hub = nullptr;
  std::function<void(Remark)> notice;
};

/// One TCP connection: HTTP, which must ask for a WebSocket with the right subprotocol from an allowed origin, then a client of the
/// hub until either side ends it.
///
/// Bounds   5 s for the request and 8 KiB for its header; a client's messages may have 1 MiB. Who does not answer a ping within 15 s
///          is disconnected, and so is one whose queue overflows.
/// Threads  one, the one that runs the socket's io_context.
class Connection {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~Connection() = default;

  virtual void start() = 0;
  /// Sends what waits in the client's queue, as far as the network takes it.
  virtual void send_waiting() = 0;
  /// Says goodbye to the client.
  virtual void close() = 0;
  virtual bool ended() const = 0;

  /// Whether the client has subscribed to anything.
  virtual bool watches() const = 0;
  /// When the other side said something last, or connected.
  virtual Clock::time_point heard_at() const = 0;
  /// Since when nothing of what waits for the client could be sent; nothing if it reads.
  virtual std::optional<Clock::time_point> stuck_since() const = 0;
  /// Ends the connection at once. A client that still reads is told why. `why`: a clause.
  virtual void dismiss(const Remark& why) = 0;
};

std::shared_ptr<Connection> make_connection(boost::asio::ip::tcp::socket socket, ConnectionRules& rules);

}  // namespace astro::foxglove
