#pragma once

#include <fcntl.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

namespace astro::support {

/// Two computers on one cable: network namespaces of this machine, joined by a pair of virtual network cards. What is sent on
/// one reaches the other and nobody else. Both are gone when the process ends, however it ends.
///
/// While it lives the calling thread is on the first computer, with the threads and programs that it starts.
class TwoComputers {
 public:
  static constexpr const char* kHere = "198.18.0.1";  // of a range for measurements, RFC 2544
  static constexpr const char* kThere = "198.18.0.2";

  /// Nothing where this machine does not allow it: it takes root and the command `ip`.
  static std::unique_ptr<TwoComputers> make() {
    std::unique_ptr<TwoComputers> two(new TwoComputers);
    if (!two->start()) two.reset();
    return two;
  }
  ~TwoComputers() {
    enter(home_);
    for (const int each : {home_, here_, there_})
      if (each >= 0) close(each);
  }
  TwoComputers(const TwoComputers&) = delete;
  TwoComputers& operator=(const TwoComputers&) = delete;

  /// What `start` starts is on the second computer.
  template <class Start>
  auto on_the_other(Start start) {
    const Visit visit(*this);
    return start();
  }

 private:
  struct Visit {
    explicit Visit(const TwoComputers& of) : two(of) { enter(two.there_); }
    ~Visit() { enter(two.here_); }
    const TwoComputers& two;
  };

  TwoComputers() : home_(current()) {}

  bool start() {
    if (unshare(CLONE_NEWNET) != 0) return false;
    there_ = current();
    if (unshare(CLONE_NEWNET) != 0) return false;
    here_ = current();
    const std::string other = "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(there_);
    return ip("link set lo up") && ip("link add card0 type veth peer name card0 netns " + other) &&
           set_up(kHere) &&
           on_the_other([] { return ip("link set lo up") && set_up(kThere) && carries(); }) && carries();
  }
  static bool set_up(const std::string& address) {
    return ip("addr add " + address + "/24 dev card0") && ip("link set card0 up");
  }
  static bool ip(const std::string& words) {
    return std::system(("ip " + words + " 2>/dev/null").c_str()) == 0;
  }
  /// The system says so a moment later. DDS leaves out a card that is not running when it starts.
  static bool carries() {
    const int any = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    ifreq card{};
    std::strcpy(card.ifr_name, "card0");
    for (int i = 0; i < 5000 && (card.ifr_flags & IFF_RUNNING) == 0; ++i) {
      poll(nullptr, 0, 1);
      if (ioctl(any, SIOCGIFFLAGS, &card) != 0) break;
    }
    close(any);
    return (card.ifr_flags & IFF_RUNNING) != 0;
  }
  static int current() { return open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC); }
  static void enter(int network) {
    if (network >= 0) setns(network, CLONE_NEWNET);
  }

  int home_, here_ = -1, there_ = -1;
};

}  // namespace astro::support
