#include "host/simulation/server/channel.hpp"

#include <algorithm>
#include <array>

namespace astro::simulation {
namespace {

// Beyond that the robot's own queue fills, and it drops frames.
constexpr std::size_t kMostOutgoing = 1U << 16;

}  // namespace

Channel::Channel(ServedRobot& robot, int port, std::filesystem::path link)
    : robot_(robot), port_(port), link_(std::move(link)) {
  if (robot_.present(port_))
    pty_.emplace(link_);
  else
    const Pty probe(link_);  // so that a bad path is an error now, and not when the port appears
}

pollfd Channel::waits_for() const {
  const int in = robot_.room(port_) != 0
                     ? POLLIN
                     : 0;  // otherwise waiting bytes would wake us although there is no room for them
  return {pty_->fd(), static_cast<short>(in | (outgoing_.empty() ? 0 : POLLOUT)), 0};
}

void Channel::update_connection() {
  if (!robot_.present(port_)) {
    pty_.reset();
    outgoing_.clear();
  } else if (!pty_) {
    pty_.emplace(link_);
  }
  connected_ = pty_ && pty_->connected();
  robot_.set_open(port_, connected_, connected_ ? pty_->baud() : 0);
}

bool Channel::receive() {
  if (!pty_) return false;
  std::array<std::uint8_t, 4096> bytes{};
  const std::size_t room = std::min(bytes.size(), robot_.room(port_));
  const std::size_t count = pty_->read(std::span(bytes).first(room));
  if (count == 0) return false;
  robot_.write(port_, std::span(bytes).first(count));
  return true;
}

bool Channel::transmit() {
  std::array<std::uint8_t, 4096> bytes{};
  std::size_t count = 0;
  while (outgoing_.size() < kMostOutgoing && (count = robot_.read(port_, bytes)) != 0)
    outgoing_.insert(outgoing_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
  if (!connected_) outgoing_.clear();  // nobody listens: the bytes are lost, as on a wire
  if (!outgoing_.empty())
    outgoing_.erase(outgoing_.begin(),
                    outgoing_.begin() + static_cast<std::ptrdiff_t>(pty_->write(outgoing_)));
  return !outgoing_.empty();
}

}  // namespace astro::simulation
