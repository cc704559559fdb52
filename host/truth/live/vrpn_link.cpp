#include "host/truth/live/vrpn_link.hpp"

#include <array>
#include <utility>

#include "host/base/error.hpp"

namespace astro::truth {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

constexpr microseconds kConnectTimeout = milliseconds(1500);
constexpr microseconds kAskPeriod = seconds(1);  // the upstream library's
constexpr microseconds kAskTimeout = seconds(3);
constexpr microseconds kRetry = seconds(1);
// The most that one call reads, so that a server that sends faster than we read cannot block us.
constexpr int kMostReads = 16;

}  // namespace

VrpnLink::VrpnLink(const TrackerUrl& url)
    : VrpnLink(url, net::Address::all_of(url.host, url.with_usual_port(vrpn::kPort).port)) {}

VrpnLink::VrpnLink(const TrackerUrl& url, std::vector<net::Address> servers)
    : url_(url.with_usual_port(vrpn::kPort)), servers_(std::move(servers)), stream_(url_.body) {}

void VrpnLink::work(microseconds now) {
  switch (state_) {
    case State::down:
      if (now < due_) return;
      tried_ = 0;
      return begin(now);
    case State::connecting: {
      const net::Connecting outcome = net::connecting(connection_);
      if (outcome == net::Connecting::connected) return rise(std::move(connection_));
      if (outcome == net::Connecting::failed || now >= deadline_) begin_next(now);
      return;
    }
    case State::asking:
      return repeat_asking(now);
    case State::up:
      return read(now);
  }
}

void VrpnLink::wait(microseconds timeout) {
  if (state_ == State::up) {
    net::wait_to_read(connection_, timeout);
  } else if (state_ == State::connecting) {
    net::wait_to_connect(connection_, timeout);
  } else {
    net::wait_to_read(listener_, timeout);  // waits in any case, if there is none
  }
}

microseconds VrpnLink::share_of(microseconds limit) const {
  return limit / static_cast<std::int64_t>(servers_.size());
}

void VrpnLink::begin(microseconds now) {
  connection_ = net::begin_tcp(server());
  state_ = State::connecting;
  deadline_ = now + share_of(kConnectTimeout);
  if (!connection_) begin_next(now);
}

void VrpnLink::begin_next(microseconds now) {
  if (++tried_ < servers_.size()) return begin(now);
  tried_ = 0;
  ask(now);
}

/// The server calls back at the address that the datagram comes from, so the address that is named in it has
/// no effect.
void VrpnLink::ask(microseconds now) {
  connection_ = {};
  try {
    asking_ = net::connect_udp(server());
    listener_ = net::listen_tcp(net::Address::local(asking_).with_port(0));
  } catch (const Error& error) {
    return ask_next(now, error.what());
  }
  state_ = State::asking;
  deadline_ = now + share_of(kAskTimeout);
  due_ = now;
  repeat_asking(now);
}

void VrpnLink::ask_next(microseconds now, const std::string& why) {
  if (++tried_ < servers_.size()) return ask(now);
  fall(now, why);
}

void VrpnLink::repeat_asking(microseconds now) {
  auto caller = net::accept_tcp(listener_);
  if (caller && caller->from.host() == server().host()) {
    called_back_ = true;
    return rise(std::move(caller->socket));
  }
  if (now >= deadline_) return ask_next(now, "nothing answers there, neither by TCP nor by a call back");
  if (now < due_) return;
  const net::Address ours = net::Address::local(listener_);
  const std::string request = ours.host() + " " + std::to_string(ours.port());
  Bytes datagram(request.begin(), request.end());
  datagram.push_back(0);
  net::send(asking_, datagram);
  due_ = now + kAskPeriod;
}

void VrpnLink::rise(net::Socket socket) {
  connection_ = std::move(socket);
  listener_ = {};
  asking_ = {};
  stream_ = VrpnStream(url_.body.empty() ? stream_.body() : url_.body);
  state_ = State::up;
  ++connections_;
  net::send(connection_, vrpn::cookie());
}

void VrpnLink::fall(microseconds now, const std::string& why) {
  connection_ = {};
  listener_ = {};
  asking_ = {};
  state_ = State::down;
  called_back_ = false;
  why_down_ = why;
  due_ = now + kRetry;
}

void VrpnLink::read(microseconds now) {
  std::array<std::uint8_t, 16384> buffer;  // NOLINT(cppcoreguidelines-pro-type-member-init): receive fills it
  try {
    for (int i = 0; i < kMostReads; ++i) {
      const auto bytes = net::receive(connection_, buffer);
      if (!bytes) return fall(now, "it has ended the connection");
      if (bytes->empty()) return;
      stream_.push(*bytes, now.count());
    }
  } catch (const Error& error) {
    fall(now, error.what());
  }
}

std::string VrpnLink::why_silent() const {
  if (state_ == State::up) return stream_.why_silent();
  return why_down_.empty() ? "nothing answers there" : why_down_;
}

}  // namespace astro::truth
