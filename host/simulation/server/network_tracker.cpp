#include "host/simulation/server/network_tracker.hpp"

#include <chrono>

namespace astro::simulation {
namespace {

net::Address address_of(const NetworkTrackerConfig& config, std::uint16_t port) {
  return config.everywhere ? net::Address::everywhere(port) : net::Address::loopback(port);
}

std::int64_t time_of_day_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

NetworkTracker::NetworkTracker(const NetworkTrackerConfig& config)
    : tracker_(config.faults), also_(config.also), now_us_(time_of_day_us()) {
  if (config.vrpn_port) vrpn_.emplace(address_of(config, *config.vrpn_port), config.body);
  if (config.natnet_port)
    natnet_.emplace(address_of(config, *config.natnet_port), config.body, config.natnet_version);
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
