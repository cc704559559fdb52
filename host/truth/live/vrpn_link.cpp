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

VrpnLink::VrpnLink(const TrackerUrl& url) : VrpnLink(url, net::addresses_of(url.host)) {}

VrpnLink::VrpnLink(const TrackerUrl& url, std::vector<net::address> servers)
    : url_(url.with_usual_port(vrpn::kPort)), servers_(std::move(servers)), stream_(url_.body) {}

void VrpnLink::work(microseconds now) {
  switch (state_) {
    case State::down:
      if (now < due_) return;
      tried_ = 0;
      return begin(now);
    case State::connecting:
      io_.restart();
      io_.poll();
      if (*attempt_->state == net::Connecting::connected) return rise(std::move(attempt_->socket));
      if (*attempt_->state == net::Connecting::failed || now >= deadline_) begin_next(now);
      return;
    case State::asking:
      return repeat_asking(now);
    case State::up:
      return read(now);
  }
}

void VrpnLink::wait(microseconds timeout) {
  if (connection_) {
    net::wait_to_read(io_, timeout, *connection_);
  } else if (listener_) {
    net::wait_to_read(io_, timeout, *listener_);
  } else {
    net::wait_to_read(io_, timeout);  // for the attempt to connect, if there is one
  }
}

microseconds VrpnLink::share_of(microseconds limit) const {
  return limit / static_cast<std::int64_t>(servers_.size());
}

void VrpnLink::begin(microseconds now) {
  attempt_ = net::begin_tcp(io_, {server(), url_.port});
  state_ = State::connecting;
  deadline_ = now + share_of(kConnectTimeout);
  if (!attempt_) begin_next(now);
}

void VrpnLink::begin_next(microseconds now) {
  if (++tried_ < servers_.size()) return begin(now);
  tried_ = 0;
  ask(now);
}

/// The server calls back at the address that the datagram comes from, so the address that is named in it has
/// no effect.
void VrpnLink::ask(microseconds now) {
  attempt_.reset();
  try {
    asking_ = net::connect_udp(io_, {server(), url_.port});
    listener_ = net::listen_tcp(io_, {asking_->local_endpoint().address(), 0});
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
  auto caller = net::accept_tcp(*listener_);
  if (caller && caller->from.address() == server()) {
    called_back_ = true;
    return rise(std::move(caller->socket));
  }
  if (now >= deadline_) return ask_next(now, "nothing answers there, neither by TCP nor by a call back");
  if (now < due_) return;
  const auto ours = listener_->local_endpoint();
  std::string request = ours.address().to_string() + " " + std::to_string(ours.port());
  request.push_back('\0');
  net::send_datagram(*asking_, as_bytes(request), {server(), url_.port});
  due_ = now + kAskPeriod;
}

void VrpnLink::drop_sockets() {
  attempt_.reset();
  connection_.reset();
  listener_.reset();
  asking_.reset();
}

void VrpnLink::rise(net::tcp::socket socket) {
  drop_sockets();
  connection_ = std::move(socket);
  stream_ = VrpnStream(url_.body.empty() ? stream_.body() : url_.body);
  state_ = State::up;
  ++connections_;
  net::send(*connection_, vrpn::cookie());
}

void VrpnLink::fall(microseconds now, const std::string& why) {
  drop_sockets();
  state_ = State::down;
  called_back_ = false;
  why_down_ = why;
  due_ = now + kRetry;
}

void VrpnLink::read(microseconds now) {
  std::array<std::uint8_t, 16384> buffer;  // NOLINT(cppcoreguidelines-pro-type-member-init): receive fills it
  try {
    for (int i = 0; i < kMostReads; ++i) {
      const auto bytes = net::receive(*connection_, buffer);
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
