#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/live/foxglove/foxglove_site.hpp"
#include "host/live/foxglove/hub.hpp"
#include "host/live/web/server.hpp"

namespace astro::foxglove {

using web::Address;
using web::ServerProblem;
using web::ViewerProblem;

/// Serves a hub on the network, in a thread of its own (host/live/web/server.hpp).
class Server {
 public:
  /// Work on the hub, done in the server's thread.
  using Task = std::function<void(Hub&)>;

  /// Listens, but serves nobody yet. `origins`: see origin.hpp. Throws astro::Error that names the address if it cannot be had.
  Server(const Address& address, std::vector<std::string> origins, std::unique_ptr<Hub> hub,
         RequestSink sink);

  std::uint16_t port() const { return server_.port(); }
  /// As those of web::Server.
  void start() { server_.start(); }
  void post(Task task) { server_.post(on_hub(std::move(task))); }
  void post_data(Task task) { server_.post_data(on_hub(std::move(task))); }
  void flush() { server_.flush(); }

 private:
  web::Server::Task on_hub(Task task) {
    return [hub = hub_.get(), task = std::move(task)] { task(*hub); };
  }

  std::unique_ptr<Hub> hub_;
  FoxgloveSite site_;
  web::Server server_;  // last: its thread uses the others
};

}  // namespace astro::foxglove
