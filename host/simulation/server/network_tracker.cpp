#include "host/simulation/server/network_tracker.hpp"

#include <fmt/format.h>

#include <chrono>

#include "host/simulation/server/natnet_server.hpp"
#include "host/simulation/server/vrpn_server.hpp"

namespace astro::simulation {
namespace {

net::address_v4 address_of(const NetworkTrackerConfig& config) {
  return config.everywhere ? net::address_v4::any() : net::address_v4::loopback();
}

template <class Endpoint>
std::string url_of(const char* scheme, const Endpoint& at, const std::string& body) {
  return fmt::format("{}://{}:{}/{}", scheme, at.address().to_string(), at.port(), body);
}

std::int64_t time_of_day_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

NetworkTracker::NetworkTracker(const NetworkTrackerConfig& config)
    : tracker_(config.faults), also_(config.also), body_(config.body), now_us_(time_of_day_us()) {
  const auto address = address_of(config);
  if (config.vrpn_port)
    vrpn_ = std::make_unique<VrpnServer>(net::tcp::endpoint(address, *config.vrpn_port), body_);
  if (config.natnet_port)
    natnet_ = std::make_unique<NatNetServer>(net::udp::endpoint(address, *config.natnet_port), body_,
                                             config.natnet_version, config.natnet_data_port);
}

NetworkTracker::~NetworkTracker() = default;

std::vector<std::string> NetworkTracker::urls() const {
  std::vector<std::string> urls;
  if (vrpn_) urls.push_back(url_of("vrpn", vrpn_->endpoint(), body_));
  if (natnet_) urls.push_back(url_of("natnet", natnet_->endpoint(), body_));
  return urls;
}

void NetworkTracker::step(const std::vector<recording::TruthSample>& seen) {
  now_us_ += 1000;
  for (const recording::TruthSample& sample : seen) tracker_.take(now_us_, sample);
  while (const auto frame = tracker_.next(now_us_)) {
    if (vrpn_) vrpn_->send(*frame);
    if (natnet_) natnet_->send(*frame, now_us_);
    if (also_) also_->send(*frame);
  }
}

void NetworkTracker::work() {
  if (vrpn_) vrpn_->work(now_us_);
  if (natnet_) natnet_->work(now_us_);
}

}  // namespace astro::simulation
