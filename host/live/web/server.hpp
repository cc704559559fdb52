#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "host/live/web/site.hpp"

namespace astro::web {

/// Values: the number of the port.
enum class ServerProblem { port_taken };

/// Why a viewer is disconnected. Values: its address.
enum class ViewerProblem { idle, stuck };

struct Address {
  std::string ip = "127.0.0.1";  // of one of this computer's networks; "0.0.0.0" or "::": all
  std::uint16_t port = 0;        // 0: any that is free
};

/// Serves a site on the network. It has its own thread, so that clients are served whatever the robot's thread does, and the
/// robot's thread does not wait, whatever a client does.
class Server {
 public:
  /// Work on the site, done in the server's thread.
  using Task = std::function<void()>;

  /// Listens, but serves nobody yet. `site` must outlive it. Throws astro::Error that names the address if it cannot be had.
  Server(const Address& address, Site& site);
  /// Says goodbye to all clients; waits no longer than a fifth of a second for that.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t port() const;

  /// Begins to serve; a second call does nothing. Tasks that were posted before come first.
  void start();
  /// May be called from any thread. Tasks are done in their order.
  void post(Task task);
  /// The same for data: it is done with the next post() or flush(), so that many messages wake the other thread once; and it is left
  /// out when thousands of tasks wait already, because the computer is too busy.
  void post_data(Task task);
  void flush();

  /// Makes room for another client that wants data: one that did not read what it was sent for some seconds goes. For the site, in
  /// the server's thread.
  void dismiss_stuck_watcher();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace astro::web
