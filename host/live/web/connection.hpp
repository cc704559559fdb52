#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <memory>
#include <optional>

#include "host/base/error.hpp"
#include "host/live/web/site.hpp"

namespace astro::web {

/// One TCP connection: one HTTP request, which is answered, or becomes a WebSocket until either side ends it.
///
/// Bounds   5 s for the request, and Limits for its size; 10 min for a body. Who does not answer a ping is disconnected, and so is
///          one whose queue overflows.
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

  /// Whether the client gets data.
  virtual bool watches() const = 0;
  /// When the other side said something last, or connected.
  virtual Clock::time_point heard_at() const = 0;
  /// Since when nothing of what waits for the client could be sent; nothing if it reads.
  virtual std::optional<Clock::time_point> stuck_since() const = 0;
  /// Ends the connection at once. A client that still reads is told why. `why`: a clause.
  virtual void dismiss(const Remark& why) = 0;
};

/// `site` must outlive it.
std::shared_ptr<Connection> make_connection(boost::asio::ip::tcp::socket socket, Site& site);

}  // namespace astro::web
