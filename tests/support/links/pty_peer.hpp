#pragma once

#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <thread>
#include <vector>

#include "tests/support/links/pty.hpp"

namespace astro::test {

/// Something at a port that is no robot, or not ours: answers bytes with bytes on a thread of its own.
class PtyPeer {
 public:
  using Bytes = std::vector<std::uint8_t>;
  using Answer = std::function<Bytes(std::span<const std::uint8_t>)>;

  explicit PtyPeer(Answer answer)
      : answer_(std::move(answer)), keeper_(open(pty_.path().c_str(), O_RDWR | O_NOCTTY)), thread_([this] {
          while (!ended_) serve();
        }) {
    termios mode{};
    tcgetattr(keeper_, &mode);
    cfmakeraw(&mode);
    tcsetattr(keeper_, TCSANOW, &mode);  // the peer decides what is echoed, not the terminal
  }
  PtyPeer(const PtyPeer&) = delete;
  PtyPeer& operator=(const PtyPeer&) = delete;
  ~PtyPeer() {
    ended_ = true;
    thread_.join();
    close(keeper_);
  }

  const std::string& path() const { return pty_.path(); }

 private:
  void serve() {
    pollfd ready{pty_.master(), POLLIN, 0};
    if (poll(&ready, 1, 5) <= 0 || (ready.revents & POLLIN) == 0) return;
    std::array<std::uint8_t, 512> buffer{};
    const auto size = read(pty_.master(), buffer.data(), buffer.size());
    if (size <= 0) return;
    const Bytes reply = answer_({buffer.data(), static_cast<std::size_t>(size)});
    if (!reply.empty() && write(pty_.master(), reply.data(), reply.size()) < 0) ended_ = true;
  }

  Answer answer_;
  Pty pty_;
  int keeper_;  // holds the other side open: a pty that nobody has open loses what is written to it
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

}  // namespace astro::test
