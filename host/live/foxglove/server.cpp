#include "host/live/foxglove/server.hpp"

#include <utility>

namespace astro::foxglove {

Server::Server(const Address& address, std::vector<std::string> origins, std::unique_ptr<Hub> hub,
               RequestSink sink)
    : hub_(std::move(hub)),
      site_(*hub_, std::move(origins),
            [sink = std::move(sink)](Remark remark) { sink(NoticeArrived{std::move(remark)}); }),
      server_(address, site_) {
  hub_->on_crowd([this] { server_.dismiss_stuck_watcher(); });
}

}  // namespace astro::foxglove
